#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cctype>

#include "schemas/campaign_reader.hpp"
#include "tests/unit/reader/base_campaign.hpp"

namespace cupola {
namespace {

struct Mistake {
  std::string name;
  std::string old_text;                 ///< of the base campaign
  std::string new_text;                 ///< what stands there instead
  std::vector<std::string> complaints;  ///< line:column: key: message
};

void PrintTo(const Mistake& mistake, std::ostream* stream) { *stream << mistake.name; }

std::vector<std::string> complaints_about(const std::string& text) {
  std::vector<std::string> lines;
  for (const auto& error : read_campaign_text(text, "file").errors) {
    const auto line = to_text({error});
    lines.push_back(line.substr(5, line.size() - 6));  // without "file:" and the line's end
  }
  return lines;
}

// clang-format off
const std::vector<Mistake> mistakes{
    {"misspelt key", "mass_flow:", "mas_flow:", {R"(8:66: scene.gas.inlets[0].mas_flow: unknown key `mas_flow` (did you mean `mass_flow`?))"}},
    {"misspelt section", "descent_rate:", "decent_rate:", {R"(24:1: decent_rate: unknown key `decent_rate` (did you mean `descent_rate`?))"}},
    {"key in the wrong section", "heat: {}", "heat: {}\nranks: 2", {R"(21:1: ranks: unknown key `ranks` (it belongs at `launch.ranks`))"}},
    {"key of nowhere", "heat: {}", "heat: {colour: red}", {R"(20:8: heat.colour: unknown key `colour` (known here: bed_conduction, convection, emissivity, intragrain_resistance, nusselt_factor))"}},
    {"length for a time", "at_most: 20 s", "at_most: 5 m", {R"(25:23: dem.stop.at_most: expected a time (like 5 s), but `5 m` is a length)"}},
    {"reciprocal", "at_most: 20 s", "at_most: 20 Hz", {R"(25:23: dem.stop.at_most: expected a time (like 5 s), but `20 Hz` is a frequency)"}},
    {"coulomb", "1475 K", "1200 C", {R"(12:96: species.ore.softening.from: expected a temperature (like 1675 K), but the `C` of `1200 C` is the coulomb: write degC or K)"}},
    {"american ton", "3 t/m3", "3000, thing: 3 ton", {R"(12:38: species.ore.thing: unknown key `thing` (known here: coarse_graining, conductivity, density, diameter, heat_capacity, none_below, softening))"}},
    {"american ton mass", "600 kg", "1 ton", {R"(21:62: charging.layers[1].ore: expected a mass (like 270 kg), but the `ton` of `1 ton` is the American one: write t for 1000 kg)"}},
    {"unknown unit", "2 mm/s", "2 mm/fortnite", {R"(24:15: descent_rate: expected a speed (like 2 mm/s), but `mm/fortnite` of `2 mm/fortnite` is not a known unit)"}},
    {"decimal comma", "2 mm/s", "\"2,5 mm/s\"", {R"(24:15: descent_rate: expected a speed (like 2 mm/s), but `2,5 mm/s` has a comma: write a decimal point)"}},
    {"not a number", "2 mm/s", ".nan", {R"(24:15: descent_rate: expected a speed (like 2 mm/s), but `.nan` is no number with a unit)"}},
    {"infinite", "2 mm/s", ".inf", {R"(24:15: descent_rate: expected a speed (like 2 mm/s), but `.inf` is no number with a unit)"}},
    {"huge", "2 mm/s", "1e999 m/s", {R"(24:15: descent_rate: expected a speed (like 2 mm/s), but `1e999 m/s` is out of the range of numbers)"}},
    {"huge by unit", "2 mm/s", "1e308 km/s", {R"(24:15: descent_rate: expected a speed (like 2 mm/s), but `1e308 km/s` is not a finite number)"}},
    {"word for a number", "2 mm/s", "fast", {R"(24:15: descent_rate: expected a speed (like 2 mm/s), but `fast` is no number with a unit)"}},
    {"nothing for a number", "2 mm/s", "", {R"(24:1: descent_rate: expected a speed (like 2 mm/s), but nothing stands here)"}},
    {"list for a number", "2 mm/s", "[1, 2]", {R"(24:15: descent_rate: expected a speed (like 2 mm/s), but a list of 2 stands here)"}},
    {"wrong criterion", "2 episodes", "2 cells", {R"(26:18: converged.for: expected a number of episodes (like 2 episodes), but `2 cells` stands here)"}},
    {"half an episode", "2 episodes", "2.5 episodes", {R"(26:18: converged.for: expected a whole number, but `2.5 episodes` stands here)"}},
    {"half an episode, number", "2 episodes", "2.5", {R"(26:18: converged.for: expected a number of episodes (like 2 episodes), but `2.5` stands here)"}},
    {"missing key", ", z: 0.5 m", "", {R"(8:9: scene.gas.inlets[0]: an inlet in a side wall needs `z`)"}},
    {"missing required", "heat_capacity: 850, ", "", {R"(10:3: species.coke: the key `heat_capacity` is missing: with `heat` every species needs it (like 850 J/kg/K))"}},
    {"missing section", "descent_rate: 2 mm/s\n", "", {R"(1:1: the key `descent_rate` is missing: expected a speed (like 2 mm/s))"}},
    {"not positive", "diameter: 44 mm", "diameter: -44 mm", {R"(10:20: species.coke.diameter: must be greater than 0, but is -0.044 m)"}},
    {"restitution above one", "restitution: 0.5", "restitution: 1.5", {R"(15:30: contacts.pairs.coke-coke.restitution: must be at most 1, but is 1.5)"}},
    {"unknown choice", "heat: {}", "heat: {}\ndrag: gidaspov", {R"(21:7: drag: expected one of ergun, wen-yu, gidaspow, di-felice, koch-hill, beetstra, emms, but `gidaspov` stands here (did you mean `gidaspow`?))"}},
    {"unknown way of removal", "dem_removal_rate: 50 kg/s", "dem_removal_rate: 50 kg/s, removal: void", {R"(23:93: raceways[0].removal: expected one of rate, keep-void, but `void` stands here)"}},
    {"overlap beyond the radius", "at_most: 20 s}}", "at_most: 20 s}, limits: {overlap: 1.5}}", {R"(25:48: dem.limits.overlap: must be at most 1, but is 1.5)"}},
    {"negative parcel correction", "heat: {}", "heat: {}\nfiltered_drag: {parcel_coefficient: -0.1}", {R"(21:37: filtered_drag.parcel_coefficient: must be at least 0, but is -0.1)"}},
    {"smoothing length as a time", "at_most: 20 s}}", "at_most: 20 s}, smoothing_length: 1 s}", {R"(25:48: dem.smoothing_length: expected a length (like 0.5 m), but `1 s` is a time)"}},
    {"boolean", "heat: {}", "heat: {}\ntracer: {clean_field: maybe}", {R"(21:23: tracer.clean_field: expected true or false, but `maybe` stands here)"}},
    {"two kinds of geometry", "{slot:", "{box: {width: 1, depth: 0.6, height: 3}, slot:", {R"(3:13: scene.geometry: expected at most 1 of: box, slot)"}},
    {"no geometry", "{slot: {depth: 0.6 m, profile: [[0, 1.5], [1, 1.5], [6, 1.2]]}}", "{}", {R"(3:13: scene.geometry: expected at least 1 of: box, slot)"}},
    {"row of three", "[1, 1.5]", "[1, 1.5, 2]", {R"(3:55: scene.geometry.slot.profile[1]: expected a list of 2, but it has 3 (Height z and half width there.))"}},
    {"bad species name", "  coke: {diam", "  \"2 coke\": {diam", {R"(10:3: species.2 coke: the name `2 coke` must begin with a letter and hold only letters, digits and _)"}},
    {"species named wall", "species:\n", "species:\n  wall: {diameter: 1 mm, density: 800, heat_capacity: 850, conductivity: 1.7}\n", {R"(10:9: species.wall: `wall` is the name of the walls in contacts.pairs: give the species another)"}},
    {"bad campaign name", "campaign: base", "campaign: ../base", {R"(1:11: campaign: `../base` is no name here: it must match ^[A-Za-z0-9][A-Za-z0-9._-]*$)"}},
    {"melts before it softens", "melted: 1675 K", "melted: 1400 K", {R"(12:112: species.ore.softening.melted: the species melts at 1400 K, but softens only from 1475 K: it must soften before it melts)"}},
    {"layer of no species", "{ore: 600 kg}", "{orr: 600 kg}", {R"(21:57: charging.layers[1].orr: there is no species `orr` (did you mean `ore`?))"}},
    {"ring outside the throat", "{ore: 600 kg}", "{ore: 600 kg, ring: [0.5 m, 2 m]}", {R"(21:76: charging.layers[1].ring: the ring from 0.5 to 2 m reaches outside the furnace, whose half width is 1.23 m there)"}},
    {"ring turned round", "{ore: 600 kg}", "{ore: 600 kg, ring: [1 m, 0.5 m]}", {R"(21:76: charging.layers[1].ring: expected [from, to] with from < to)"}},
    {"ring of nothing", "{ore: 600 kg}", "{ring: [0.2 m, 0.5 m]}", {R"(21:56: charging.layers[1]: expected a mass of some species, like {coke: 270 kg})"}},
    {"longest time without steady", "heat: {}", "heat: {}\ntracer: {stop: {at_most: 5 h}}", {R"(21:26: tracer.stop.at_most: this needs `when: steady`; by itself an episode lasts tracer.duration)"}},
    {"steady without heat", "heat: {}", "tracer: {stop: {when: steady}}", {R"(20:23: tracer.stop.when: `steady` is judged by the temperatures, but the scene has no `heat`)"}},
    {"excluded box turned round", "heat: {}", "heat: {}\ntracer: {displacement_excludes: {boxes: [{x: [1, 0], y: [0, 1], z: [0, 1]}]}}", {R"(21:46: tracer.displacement_excludes.boxes[0].x: expected [from, to] with from < to)"}},
    {"pair of no species", "ore-coke:", "ore-cake:", {R"(17:5: contacts.pairs.ore-cake: `ore-cake` is no pair of species, or of a species and `wall` (did you mean `ore-coke`?))"}},
    {"pair twice", "    ore-ore:", "    coke-ore: {restitution: 0.2, friction: 0.8, rolling: 0.02}\n    ore-ore:", {R"(18:5: contacts.pairs.ore-coke: this pair stands here a second time; the first is `coke-ore`)"}},
    {"missing pair", "    ore-wall: {restitution: 0.2, friction: 0.2, rolling: 0.02}\n", "", {R"(14:3: contacts.pairs: the pair `ore-wall` is missing)"}},
    {"linear spring without stiffness", "contacts:\n", "contacts:\n  model: linear-spring\n", {R"(14:3: contacts: the model linear-spring needs `stiffness` (like 1e4 N/m))"}},
    {"inlet above the wall", "z: 0.5 m", "z: 6.1 m", {R"(8:37: scene.gas.inlets[0].z: the opening from 6 to 6.2 m is outside the wall, which goes from 0 to 6 m)"}},
    {"inlet deeper than the slot", "[0.2 m, 0.2 m]", "[0.7 m, 0.2 m]", {R"(8:51: scene.gas.inlets[0].size[0]: the opening is 0.7 m along y, but the wall only 0.6 m)"}},
    {"inlet over a corner", "z: 0.5 m", "z: 1.05 m", {R"(8:37: scene.gas.inlets[0].z: the opening from 0.95 to 1.15 m lies over the profile's corner at 1 m: move it or make it lower)"}},
    {"inlet side without size", ", size: [0.2 m, 0.2 m]", "", {R"(8:9: scene.gas.inlets[0]: an inlet in a side wall needs `size`)"}},
    {"bottom inlet with height", "side: left", "side: bottom", {R"(8:39: scene.gas.inlets[0].z: the bottom is an inlet as a whole: leave `z` out)", R"(8:52: scene.gas.inlets[0].size: the bottom is an inlet as a whole: leave `size` out)"}},
    {"inlet named like a patch", "name: left", "name: outlet", {R"(8:16: scene.gas.inlets[0].name: `outlet` is a patch of the mesh already: choose another name)"}},
    {"unknown gas", "species: blast", "species: argon", {R"(6:14: scene.gas.species: `argon` is not a known gas (air, nitrogen, blast): expected one, or also its molar_mass, heat_capacity, viscosity, prandtl)"}},
    {"misspelt gas", "species: blast", "species: nitrogn", {R"(6:14: scene.gas.species: `nitrogn` is not a known gas (air, nitrogen, blast) (did you mean `nitrogen`?): expected one, or also its molar_mass, heat_capacity, viscosity, prandtl)"}},
    {"no inlets", "    inlets:\n      - {name: left, side: left, z: 0.5 m, size: [0.2 m, 0.2 m], mass_flow: 1.4 kg/s, total_temperature: 2600 K}\n", "", {R"(5:3: scene.gas: the key `inlets` is missing: expected a list)"}},
    {"inlet without flow", "mass_flow: 1.4 kg/s, ", "", {R"(8:9: scene.gas.inlets[0]: one of the keys mass_flow, velocity and pressure is missing: expected a mass flow (like 1.4 kg/s))"}},
    {"inlet with two flows", "mass_flow: 1.4 kg/s", "mass_flow: 1.4 kg/s, velocity: 200 m/s", {R"(8:97: scene.gas.inlets[0].velocity: an inlet states one of mass_flow, velocity and pressure, but here stand mass_flow and velocity)"}},
    {"inlet below the outlet's pressure", "mass_flow: 1.4 kg/s", "pressure: 0.9 bar", {R"(8:76: scene.gas.inlets[0].pressure: no gas flows in at 90000 Pa against 100000 Pa at the outlet)"}},
    {"sutherland of a strange gas", "species: blast", "species: argon\n    molar_mass: 40 g/mol\n    heat_capacity: 520\n    viscosity: 2e-5\n    prandtl: 0.67\n    viscosity_model: sutherland", {R"(6:5: scene.gas: this gas needs the key `sutherland`)"}},
    {"janaf ranges out of order", "species: blast", "species: blast\n    janaf: {from: 300, common: 200, to: 1000, low: [1, 0, 0, 0, 0, 0, 0], high: [1, 0, 0, 0, 0, 0, 0]}", {R"(7:12: scene.gas.janaf: expected from < common < to, but these are 300, 200 and 1000 K)"}},
    {"janaf of six coefficients", "species: blast", "species: blast\n    janaf: {from: 200, common: 1000, to: 6000, low: [1, 0, 0, 0, 0, 0], high: [1, 0, 0, 0, 0, 0, 0]}", {R"(7:53: scene.gas.janaf.low: expected a list of 7, but it has 6 (The seven coefficients of the lower range.))"}},
    {"table of a wrong unit", "heat_capacity: 850", "heat_capacity: [[300 K, 800 J/kg/K], [1000 K, 2 W/m/K]]", {R"(10:107: species.coke.heat_capacity[1][1]: expected a specific heat capacity (like 850 J/kg/K), but `2 W/m/K` is a heat conductivity)"}},
    {"table that falls", "heat_capacity: 850", "heat_capacity: [[300, 800], [200, 900]]", {R"(10:89: species.coke.heat_capacity[1]: temperatures must rise from row to row, but 200 K follows 300 K)"}},
    {"table of one row", "heat_capacity: 850", "heat_capacity: [[300, 800]]", {R"(10:76: species.coke.heat_capacity: expected a list of at least 2, but it has 1 (Heat capacity: a number, or a table of rows [temperature, heat capacity].))"}},
    {"negative latent heat", "melted: 1675 K", "melted: 1675 K, latent_heat: -1 kJ/kg", {R"(12:133: species.ore.softening.latent_heat: must be at least 0, but is -1000 J/kg)"}},
    {"unknown convection", "heat: {}", "heat: {convection: gun}", {R"(20:20: heat.convection: expected one of ranz-marshall, gunn, wakao, but `gun` stands here (did you mean `gunn`?))"}},
    {"heat without gas", "  gas:\n    species: blast\n    inlets:\n      - {name: left, side: left, z: 0.5 m, size: [0.2 m, 0.2 m], mass_flow: 1.4 kg/s, total_temperature: 2600 K}\n", "", {R"(16:7: heat: this needs a gas, but the scene has none (scene.gas))"}},
    {"heat without gas model", "heat: {}", "heat: {}\ntracer: {gas: none}", {R"(21:15: tracer.gas: heat needs a gas model in the tracer stage, but `none` stands here)"}},
    {"stock line outside", "stock_line: 5.5 m", "stock_line: 9 m", {R"(21:24: charging.stock_line: 9 m is not between the bottom, 0 m, and the top of the charging hopper, 6.816 m)"}},
    {"layer too large", "600 kg", "60 t", {R"(21:56: charging.layers[1]: the layer would be 25.25 m thick in the throat, more than the furnace is high: check its masses)"}},
    {"layer larger than the given hopper", "{ore: 600 kg}]", "{ore: 6 t}], hopper_height: 0.2 m", {R"(21:56: charging.layers[1]: the layer takes 3.636 m3, but there are only 1.017 m3 between the stock line and the top of the charging hopper: charge less at once, lower the stock line or raise charging.hopper_height)"}},
    {"raceway outside", "x: [1, 1.5]", "x: [1, 1.7]", {R"(23:15: raceways[0].box.x: the box reaches outside the furnace, which goes from -1.5 to 1.5 m there)"}},
    {"raceway below", "z: [0.3, 0.7]", "z: [-0.3, 0.7]", {R"(23:44: raceways[0].box.z: the box reaches outside the furnace, which goes from 0 to 6 m)"}},
    {"raceway turned", "y: [-0.3, 0.3]", "y: [0.3, -0.3]", {R"(23:28: raceways[0].box.y: expected [from, to] with from < to)"}},
    {"profile does not rise", "[1, 1.5], ", "[7, 1.5], ", {R"(3:65: scene.geometry.slot.profile[2]: z must rise from row to row, but 6 m follows 7 m)"}},
    {"half width zero", "[6, 1.2]", "[6, 0]", {R"(3:65: scene.geometry.slot.profile[2]: the half width must be greater than 0, but is 0 m)"}},
    {"too shallow periodic sides", "depth: 0.6 m", "depth: 0.3 m", {R"(3:28: scene.geometry.slot.depth: periodic sides need a depth of at least twice the largest parcel plus skin, 0.3872 m, but it is 0.3 m: make it deeper, lower coarse_graining or set `sides: walls`)", R"(23:28: raceways[0].box.y: the box reaches outside the furnace, which goes from -0.15 to 0.15 m)"}},
    {"no cell size", "{cell: 0.2 m}", "{}", {R"(4:9: scene.mesh: expected `cell` (an edge length like 0.2 m) or `cells` (counts))"}},
    {"counts of another profile", "{cell: 0.2 m}", "{cells: {half_width: 8, depth: 3, heights: [5, 5, 5]}}", {R"(4:52: scene.mesh.cells.heights: expected one count for each of the 2 sections of the profile, but there are 3)"}},
    {"window longer than the stage", "{stop: {at_most: 20 s}}", "{stop: {at_most: 20 s}, window: 30 s}", {R"(25:23: dem.stop.at_most: relaxation (1 s) and averaging window (30 s) do not fit into the longest time of the stage, 20 s)"}},
    {"windows of a march", "heat: {}", "heat: {}\npredict_and_verify: {windows: 5}", {R"(21:21: predict_and_verify: this needs `strategy: predict-and-verify`)"}},
    {"too few windows", "heat: {}", "heat: {}\nstrategy: predict-and-verify\npredict_and_verify: {windows: 3}", {R"(22:31: predict_and_verify.windows: must be at least 4, but is 3)"}},
    {"prediction of a cold scene", "heat: {}", "strategy: predict-and-verify", {R"(20:11: strategy: a prediction needs `heat`; a cold scene: `strategy: march`)"}},
    {"prediction until steady", "heat: {}", "heat: {}\nstrategy: predict-and-verify\ntracer: {stop: {when: steady}}", {R"(22:23: tracer.stop.when: `steady` does not go with predict-and-verify, which marches `predict_and_verify.windows` layer passages and `tracer.duration` where a prediction fails)"}},
    {"gas steps without transient gas", "{stop: {at_most: 20 s}}", "{stop: {at_most: 20 s}, transient: {courant: 0.3}}", {R"(25:41: dem.transient: only the transient gas makes steps of its own (dem.gas: transient))"}},
    {"dead man above the stock line", "heat: {}", "heat: {}\ndead_man: {tip: 90 m}", {R"(21:17: dead_man.tip: 90 m is not between the bottom, 0 m, and the stock line, 5.5 m)"}},
    {"for longer than at most", "for: 2 episodes", "for: 9 episodes", {R"(26:18: converged.for: 9 episodes in a row cannot happen in at most 8)"}},
    {"none_below of a hard species", "conductivity: 1.7", "conductivity: 1.7, none_below: 1 m", {R"(10:112: species.coke.none_below: only a species with `softening` can have this)"}},
    {"cold cohesive zone", "heat: {}", "heat: {}\ninitial: {cohesive_zone: {inverted_v: {tip: 2 m, slope: 0.5, below: 300, above: 2700}}}", {R"(21:69: initial.cohesive_zone.inverted_v.below: it must be hotter below the zone (300 K) than above it (2700 K))"}},
    {"heat of nothing", "heat: {}", "heat:", {R"(20:1: heat: expected a section of keys, but nothing stands here)"}},
    {"repeated key", "heat: {}", "heat: {}\nheat: {}", {R"(21:1: heat: `heat` stands here a second time; the first is in line 20)"}},
    {"repeated species", "  ore:\n", "  coke: {diameter: 1 mm}\n  ore:\n", {R"(11:3: species.coke: `coke` stands here a second time; the first is in line 10)"}},
    {"alias", "heat: {}", "heat: &a [*a]", {R"(20:11: this is not YAML: aliases (`*name`) are not allowed: write the value out)"}},
    {"tab", "  mesh:", "\tmesh:", {R"(4:2: this is not YAML: end of map not found (there is a tab in this line: YAML indents with blanks))"}},
    {"open bracket", "converged: {", "converged: [", {R"(26:49: this is not YAML: illegal flow end)"}},
    {"second document", "heat: {}", "heat: {}\n---", {R"(1:1: one document was expected, but a second one begins with `---`)"}},
};
// clang-format on

class CampaignMistake : public testing::TestWithParam<Mistake> {};

TEST_P(CampaignMistake, IsNamedWithPlaceKeyAndCure) {
  const auto& mistake = GetParam();
  EXPECT_THAT(complaints_about(test::spoilt(mistake.old_text, mistake.new_text)),
              testing::ElementsAreArray(mistake.complaints));
}

INSTANTIATE_TEST_SUITE_P(All, CampaignMistake, testing::ValuesIn(mistakes), [](const auto& info) {
  std::string name = info.param.name;
  for (auto& letter : name) {
    if (std::isalnum(static_cast<unsigned char>(letter)) == 0) letter = '_';
  }
  return name;
});

TEST(CampaignReader, AcceptsTheBaseCampaign) { EXPECT_THAT(complaints_about(test::base_campaign), testing::IsEmpty()); }

TEST(CampaignReader, ListsAllMistakesOfAFileInItsOrder) {
  auto text = test::spoilt("mass_flow:", "mas_flow:");
  const auto replace = [&](const std::string& from, const std::string& to) {
    text.replace(text.find(from), from.size(), to);
  };
  replace("melted: 1675 K", "melted: 1400 K");
  replace("{ore: 600 kg}", "{orr: 600 kg}");
  replace("at_most: 20 s", "at_most: 5 m");
  EXPECT_THAT(complaints_about(text),
              testing::ElementsAre(testing::StartsWith("8:66: scene.gas.inlets[0].mas_flow: "),
                                   testing::StartsWith("12:112: species.ore.softening.melted: "),
                                   testing::StartsWith("21:57: charging.layers[1].orr: "),
                                   testing::StartsWith("25:23: dem.stop.at_most: ")));
}

TEST(CampaignReader, RefusesWhatIsNoSectionOfKeys) {
  EXPECT_THAT(complaints_about(""), testing::ElementsAre("1:1: the file is empty"));
  EXPECT_THAT(complaints_about("# nothing\n"), testing::ElementsAre("1:1: the file is empty"));
  const auto no_keys = "1:1: expected a section of keys, beginning with `campaign: name`";
  for (const auto* text : {"[1, 2]", "null", "campaign"})
    EXPECT_THAT(complaints_about(text), testing::ElementsAre(no_keys)) << text;
}

TEST(CampaignReader, RefusesEndlessDepthAndSize) {
  EXPECT_THAT(complaints_about(std::string(100000, '[')), testing::SizeIs(1));
  std::string stairs;
  for (int i = 0; i < 300; ++i) stairs += std::string(static_cast<std::size_t>(i), ' ') + "a:\n";
  EXPECT_THAT(complaints_about(stairs),
              testing::ElementsAre("65:65: this is not YAML: more levels than any campaign needs"));
  std::string many = "a: [";
  for (int i = 0; i < 200000; ++i) many += "1,";
  EXPECT_THAT(complaints_about(many + "]"),
              testing::ElementsAre(testing::HasSubstr("more values than any campaign needs")));
  EXPECT_THAT(complaints_about(std::string(2000000, 'a')),
              testing::ElementsAre(testing::HasSubstr("larger than 1 MB")));
}

}  // namespace
}  // namespace cupola
