# fmu.py rollbem_patch.fmu PICTURE.svg: a wheel on a rail whose waves of 4 cm take and give half of the load.
import subprocess, sys
import numpy as np
from fmpy import simulate_fmu

t = np.linspace(0, 4e-3, 401)  # s: 8 cm at 20 m/s
inputs = {"time": t, "longitudinal_slip_velocity": 0.06 + 0 * t, "lateral_slip_velocity": 0.03 + 0 * t,
          "rolling_speed": 20 + 0 * t, "normal_load": 1e5 * (1 + 0.5 * np.sin(2 * np.pi * 20 * t / 0.04))}
result = simulate_fmu(sys.argv[1], fmi_type="CoSimulation", start_values={"initial_state": 2}, stop_time=t[-1],
                      output_interval=t[1], input=np.rec.fromarrays(inputs.values(), names=",".join(inputs)),
                      output=["normal_load", "longitudinal_force", "lateral_force"])
rows = "\n".join(f"{2000 * s} {0.3 * N / 1000} {-x / 1000} {-y / 1000}" for s, N, x, y in result)
subprocess.run(["gnuplot"], check=True, text=True, input=f"""$data << EOD\n{rows}\nEOD
set terminal svg size 600,420 font 'sans-serif,18' background '#ffffff'; set output '{sys.argv[2]}'; set grid
set xlabel 'distance rolled [cm]'; set ylabel 'force on the wheel [kN]'; set yrange [0:70]
plot $data using 1:2 with lines lw 2 dt 2 lc rgb 'black' title 'friction coefficient times load', \\
     '' using 1:3 with lines lw 2 lc rgb '#0072b2' title 'longitudinal, reversed', \\
     '' using 1:4 with lines lw 2 dt 4 lc rgb '#d55e00' title 'lateral, reversed'""")
