"""test_docs.py PAGE SCRIPT DESCRIBE...: the page contains the example and the FMUs' own tables of variables."""
import subprocess
import sys

page = open(sys.argv[1]).read()
for name, text in [(sys.argv[2], "```python\n" + open(sys.argv[2]).read() + "```"),
                   *((program, subprocess.run([program, "--table"], capture_output=True, text=True, check=True).stdout)
                     for program in sys.argv[3:])]:
    if text not in page:
        sys.exit(f"{sys.argv[1]} does not hold this, which {name} has:\n{text}")
