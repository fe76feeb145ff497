#include "law.hpp"

namespace friction {

const std::vector<NamedLaw>& laws() {
    using study::Numbers;
    using study::Options;
    static const std::vector<NamedLaw> all{
        {"falling",
         "K,VH",
         "law of friction that falls with slip from mu_0 to K mu_0, by half at a slip velocity VH [V mu_0 p0/G], K 0 "
         "or more, VH above 0; constant mu without it",
         {"falling_ratio", "half_velocity"},
         [](const Options& options) {
             const auto law = options.pair("falling");
             options.require(law && law->first >= 0 && law->second > 0, "falling",
                             "be K,VH with K >= 0 and VH > 0, both finite");
             return Numbers{law->first, law->second};
         },
         [](const Numbers& of) {
             return std::function<double(double)>(rollbem::ExponentialFall<>{1, of[0], of[1]});
         },
         "μ falls to μ_0 times ",
         ", by half at a slip of "},
    };
    return all;
}

std::vector<std::string> law_options() {
    std::vector<std::string> names;
    for (const NamedLaw& law : laws()) names.push_back(law.option);
    return names;
}

void add_law_options(study::Options& options) {
    for (const NamedLaw& law : laws()) {
        const auto added = options.add(law.option, law.value, law.help);
        for (const NamedLaw& other : laws()) {
            if (&other < &law) added.not_with(other.option);
        }
    }
    options
        .add("memory", "D,V0",
             "memory of friction: distance D of slip [a mu_0 p0/G], above 0, within which mu follows its law, passed "
             "at a velocity of at least V0 [V mu_0 p0/G], 0 or more; mu follows its law at once without it")
        .only_with(law_options());
}

std::optional<SlipLaw> read_law(const study::Options& options) {
    for (const NamedLaw& named : laws()) {
        if (!options.given(named.option)) continue;
        SlipLaw law{named, named.read(options)};
        if (!options.given("memory")) return law;
        const auto memory = options.pair("memory");
        options.require(memory && memory->first > 0 && memory->second >= 0, "memory",
                        "be D,V0 with D > 0 and V0 >= 0, both finite");
        law.memory = {.distance = memory->first, .least_velocity = memory->second};
        return law;
    }
    return std::nullopt;
}

}  // namespace friction
