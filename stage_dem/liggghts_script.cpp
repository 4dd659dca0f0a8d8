#include "stage_dem/liggghts_script.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "physics/closures/collision_time.hpp"
#include "schemas/failure.hpp"
#include "stage_dem/parcels.hpp"

namespace cupola {
namespace {

double largest_half_width(const Campaign& campaign) {
  double largest = 0;
  for (const auto& corner : campaign.scene.geometry.profile) largest = std::max(largest, corner[1]);
  return largest;
}

/// `fix ID all property/global NAME peratomtypepair N v11 v12 …` from a function of two indices, the wall's last.
std::string pair_property(const Campaign& campaign, const std::string& name,
                          const std::function<double(std::size_t, std::size_t)>& value) {
  const std::size_t types = campaign.species.size() + 1;
  std::string line = fmt::format("fix {0} all property/global {0} peratomtypepair {1}", name, types);
  for (std::size_t i = 0; i < types; ++i)
    for (std::size_t j = 0; j < types; ++j) line += fmt::format(" {:.17g}", value(std::min(i, j), std::max(i, j)));
  return line;
}

std::string type_property(const Campaign& campaign, const std::string& name, double value, double wall_value) {
  std::vector<double> values(campaign.species.size(), value);
  values.push_back(wall_value);
  return fmt::format("fix {0} all property/global {0} peratomtype {1:.17g}", name, fmt::join(values, " "));
}

std::string contact_model(const Contacts& contacts) {
  std::string model = contacts.model == Contacts::Model::hertz ? "hertz" : "hooke/stiffness";
  model += " tangential history";
  if (contacts.rolling_model == Contacts::Rolling::cdt) model += " rolling_friction cdt";
  if (contacts.rolling_model == Contacts::Rolling::epsd) model += " rolling_friction epsd";
  if (contacts.rolling_model == Contacts::Rolling::epsd2) model += " rolling_friction epsd2";
  return model;
}

/// Settings of the contact model, which LIGGGHTS wants last on a line.
std::string contact_settings(const Contacts& contacts) {
  return contacts.model == Contacts::Model::linear_spring ? " absolute_damping on" : "";
}

void add_linear_spring(const Campaign& campaign, std::vector<std::string>& script) {
  const auto stiffness = [&](std::size_t i, std::size_t j) { return pair_stiffness(campaign, i, j); };
  const auto tangential = [&](std::size_t i, std::size_t j) {
    return campaign.contacts.tangential_ratio * pair_stiffness(campaign, i, j);
  };
  const auto damping = [&](std::size_t i, std::size_t j) {
    const std::size_t wall = campaign.species.size();
    if (i == wall) return pair_damping(campaign.contacts.stiffness, parcel_mass(campaign.species.front()), 0.5);
    const double mass_i = parcel_mass(campaign.species[i]);
    const double reduced_mass = j == wall ? mass_i : cupola::reduced_mass(mass_i, parcel_mass(campaign.species[j]));
    return pair_damping(pair_stiffness(campaign, i, j), reduced_mass, contact_pair(campaign, i, j).restitution);
  };
  script.push_back(pair_property(campaign, "kn", stiffness));
  script.push_back(pair_property(campaign, "kt", tangential));
  script.push_back(pair_property(campaign, "gamman_abs", damping));
  script.push_back(pair_property(campaign, "gammat_abs", damping));
}

}  // namespace

ContactPair contact_pair(const Campaign& campaign, std::size_t first, std::size_t second) {
  const std::size_t wall = campaign.species.size();
  if (first == wall && second == wall) return {};  // walls do not touch each other, but LIGGGHTS wants a value
  const auto name = [&](std::size_t index) {
    return index == wall ? std::string("wall") : campaign.species[index].name;
  };
  const std::string key = name(first) + "-" + name(second);
  const auto found = campaign.contacts.pairs.find(key);
  if (found == campaign.contacts.pairs.end())
    throw Failure(ExitCode::wrong_input, fmt::format("contacts.pairs has no entry for {}", key))
        .at("key", "contacts.pairs");
  return found->second;
}

double pair_stiffness(const Campaign& campaign, std::size_t first, std::size_t second) {
  const std::size_t wall = campaign.species.size();
  const auto factor = [&](std::size_t i) {
    return campaign.contacts.stiffness_factor(campaign.species[i].coarse_graining);
  };
  if (first == wall) return campaign.contacts.stiffness;
  if (second == wall) return factor(first) * campaign.contacts.stiffness;
  return parcel_pair_stiffness(campaign.contacts.stiffness, factor(first), factor(second));
}

double pair_damping(double stiffness, double reduced_mass, double restitution) {
  return collision_damping(reduced_mass, stiffness, std::clamp(restitution, 0.001, 1.0));
}

std::vector<std::string> liggghts_opening(const Campaign& campaign, int ranks) {
  // Bricks side by side across the slot share a bed of any height evenly; where they would be thinner than four parcels
  // the rest of the ranks is put on top of each other.
  const double thinnest = 4 * largest_diameter(campaign);
  int across = 1;
  for (int n = 1; n <= ranks; ++n)
    if (ranks % n == 0 && 2 * largest_half_width(campaign) / n >= thinnest) across = n;
  std::vector<std::string> script{
      "atom_style granular",
      // Exact tags; no sorting, so that the order of parcels (and with it round-off) depends on the run alone.
      "atom_modify map array sort 0 0", fmt::format("boundary f {} f", period(campaign) > 0 ? "p" : "f"), "newton off",
      "communicate single vel yes", "units si", fmt::format("processors {} 1 {}", across, ranks / across)};
  // LIGGGHTS asks for this word above 1 GPa, so that nobody chooses the short step of real stiffness unawares.
  if (std::max(campaign.contacts.youngs_modulus, campaign.contacts.wall_youngs_modulus) > 1e9)
    script.push_back("hard_particles yes");
  if (std::min(campaign.contacts.youngs_modulus, campaign.contacts.wall_youngs_modulus) < 5e6)
    script.push_back("soft_particles yes");  // the same below 5 MPa; the limit of the overlap says what is too soft
  return script;
}

std::vector<std::string> liggghts_box(const Campaign& campaign) {
  const double margin = largest_diameter(campaign);
  const double x = largest_half_width(campaign) + margin;
  const double y = campaign.scene.geometry.depth / 2 + (period(campaign) > 0 ? 0 : margin);
  return {fmt::format("region domain block {:.17g} {:.17g} {:.17g} {:.17g} {:.17g} {:.17g} units box", -x, x, -y, y,
                      campaign.bottom() - margin, campaign.hopper_top() + margin),
          fmt::format("create_box {} domain", campaign.species.size() + 1)};
}

std::vector<std::string> liggghts_physics(const Campaign& campaign, const std::string& wall_file, double time_step) {
  const Contacts& contacts = campaign.contacts;
  const std::string model = contact_model(contacts);
  const auto restitution = [&](std::size_t i, std::size_t j) { return contact_pair(campaign, i, j).restitution; };
  std::vector<std::string> script{
      fmt::format("neighbor {:.17g} bin", 0.12 * largest_diameter(campaign)),
      "neigh_modify delay 0",
      pair_property(campaign, "coefficientFriction",
                    [&](std::size_t i, std::size_t j) { return contact_pair(campaign, i, j).friction; }),
  };
  if (contacts.rolling_model != Contacts::Rolling::none)
    script.push_back(pair_property(campaign, "coefficientRollingFriction",
                                   [&](std::size_t i, std::size_t j) { return contact_pair(campaign, i, j).rolling; }));
  if (contacts.rolling_model == Contacts::Rolling::epsd)
    script.push_back(pair_property(campaign, "coefficientRollingViscousDamping",
                                   [&](std::size_t, std::size_t) { return contacts.rolling_damping; }));
  if (contacts.model == Contacts::Model::hertz) {
    script.push_back(pair_property(campaign, "coefficientRestitution", restitution));
    script.push_back(type_property(campaign, "youngsModulus", contacts.youngs_modulus, contacts.wall_youngs_modulus));
    script.push_back(type_property(campaign, "poissonsRatio", contacts.poisson_ratio, contacts.poisson_ratio));
  } else {
    add_linear_spring(campaign, script);
  }
  const std::vector<std::string> rest{
      fmt::format("pair_style gran model {}{}", model, contact_settings(contacts)),
      "pair_coeff * *",
      fmt::format("timestep {:.17g}", time_step),
      fmt::format("fix wall_mesh all mesh/surface file {} type {}", wall_file, campaign.species.size() + 1),
      fmt::format("fix walls all wall/gran model {} mesh n_meshes 1 meshes wall_mesh{}", model,
                  contact_settings(contacts)),
      // What the contacts gave in the last step: stored here, before gravity and gas are added; kept beside the parcel
      // (force, torque, whether there is one) from block to block and in restarts.
      "fix contact_force all store/force",
      "fix last_contact all property/atom last_contact vector yes no no 0. 0. 0. 0. 0. 0. 0.",
      "fix gravity all gravity 9.81 vector 0.0 0.0 -1.0",
      // Ksl, uf and dragforce a parcel are written by the host; nothing is exchanged by LIGGGHTS itself.
      "fix coupling all couple/cfd couple_every 0 mpi",
      "fix gas_force all couple/cfd/force/implicit",
      "fix block_begin all property/atom block_begin vector yes no no 0. 0. 0.",
      // Parcels that stand still; none has the type of the walls, so that the group begins empty.
      fmt::format("group held type {}", campaign.species.size() + 1),
      "fix stand_still held freeze",
      "fix integration all nve/sphere",
      "thermo_style custom step atoms ke",
      "thermo 1000000000",
      "thermo_modify lost ignore norm no",
  };
  script.insert(script.end(), rest.begin(), rest.end());
  return script;
}

}  // namespace cupola
