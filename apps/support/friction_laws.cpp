#include "friction_laws.hpp"

#include "input.hpp"

namespace study {

const std::vector<FrictionLawRow>& friction_laws() {
    static const std::vector<FrictionLawRow> laws{
        {.option = "falling",
         .values = "K,VH",
         .help = "law of friction that falls with slip from mu_0 to K mu_0, by half at a slip velocity VH [V mu_0 "
                 "p0/G], K 0 or more, VH above 0; constant mu without it",
         .parameters = {{"falling_ratio", "parameters of --falling"}, {"half_velocity", ""}},
         .rule = "be K,VH with K >= 0 and VH > 0, both finite",
         .holds = [](const std::vector<double>& p) { return p[0] >= 0 && p[1] > 0; },
         .law = [](const std::vector<double>& p) -> rollbem::Friction::Law {
             return rollbem::ExponentialFall{1, p[0], p[1]};
         },
         .title = {"μ falls to μ_0 times ", ", by half at a slip of "}}};
    return laws;
}

std::vector<std::string> friction_law_options() {
    std::vector<std::string> names;
    for (const FrictionLawRow& row : friction_laws()) names.push_back(row.option);
    return names;
}

std::string friction_law_flags() {
    std::string flags;
    for (const FrictionLawRow& row : friction_laws()) flags += (flags.empty() ? "--" : " or --") + row.option;
    return flags;
}

void add_friction_laws(Options& options) {
    std::vector<std::string> before;
    for (const FrictionLawRow& row : friction_laws()) {
        const auto added = options.add(row.option, row.values, row.help);
        for (const std::string& other : before) added.not_with(other, ", another law of friction");
        before.push_back(row.option);
    }
    options
        .add("memory", "D,V0",
             "memory of friction: distance D of slip [a mu_0 p0/G], above 0, within which mu follows its law, passed "
             "at a velocity of at least V0 [V mu_0 p0/G], 0 or more; mu follows its law at once without it")
        .only_with(friction_law_options());
}

std::optional<ChosenLaw> read_friction_law(const Options& options) {
    for (const FrictionLawRow& row : friction_laws()) {
        if (!options.given(row.option)) continue;
        ChosenLaw chosen{&row, options.row(row.option, row.parameters.size())};
        options.require(!chosen.parameters.empty() && row.holds(chosen.parameters), row.option, row.rule);
        if (!options.given("memory")) return chosen;
        const auto memory = options.pair("memory");
        options.require(memory && memory->first > 0 && memory->second >= 0, "memory",
                        "be D,V0 with D > 0 and V0 >= 0, both finite");
        chosen.memory = {.distance = memory->first, .least_velocity = memory->second};
        return chosen;
    }
    return std::nullopt;
}

std::string friction_law_title(const Options& options) {
    std::string title;
    const auto say = [&](const std::string& name, const std::vector<std::string>& before) {
        if (!options.given(name)) return;
        const std::vector<std::string> values = cells_of(options.text(name));
        title += ", ";
        for (std::size_t k = 0; k < before.size() && k < values.size(); ++k) title += before[k] + values[k];
    };
    for (const FrictionLawRow& row : friction_laws()) say(row.option, row.title);
    say("memory", {"memory ", " and "});
    return title;
}

}  // namespace study
