#include "physics/plan/heat_balance.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "physics/closures/biot.hpp"
#include "physics/closures/carson.hpp"
#include "physics/closures/convection.hpp"
#include "physics/closures/gas_properties.hpp"
#include "physics/closures/gas_state.hpp"
#include "physics/closures/layer_exchange.hpp"
#include "physics/closures/solid_enthalpy.hpp"

namespace cupola {
namespace {

/// Wall area per metre of height, m: the two side walls, and front and back where they are walls.
double wall_perimeter(const Campaign& campaign, double z) {
  const Geometry& geometry = campaign.scene.geometry;
  const double step = 1e-4;
  const double slope = (campaign.half_width(z + step) - campaign.half_width(z - step)) / (2 * step);
  const double sides = 2 * geometry.depth * std::hypot(1.0, slope);
  return geometry.sides == Geometry::Sides::walls ? sides + 4 * campaign.half_width(z) : sides;
}

/// The campaign's exchange at a height of the bed.
class CampaignExchange {
 public:
  CampaignExchange(const Campaign& campaign, const Charge& charge, const std::vector<std::size_t>& kinds,
                   double gas_mass_flow, double gas_temperature)
      : campaign_(campaign),
        charge_(charge),
        kinds_(kinds),
        gas_mass_flow_(gas_mass_flow),
        gas_temperature_(gas_temperature),
        gas_viscosity_(GasState(*campaign.scene.gas).viscosity((gas_temperature + campaign.charging.temperature) / 2)),
        gas_conductivity_(
            GasState(*campaign.scene.gas).conductivity((gas_temperature + campaign.charging.temperature) / 2)) {}

  BedExchange operator()(double z, const std::vector<bool>& present) const {
    const double area = slot_area(campaign_, z);
    double share_present = 0;
    for (std::size_t k = 0; k < kinds_.size(); ++k) share_present += present[k] ? charge_.volume_share[kinds_[k]] : 0;
    BedExchange exchange;
    for (std::size_t k = 0; k < kinds_.size(); ++k) {
      const Species& species = campaign_.species[kinds_[k]];
      const double share = present[k] ? charge_.volume_share[kinds_[k]] / share_present : 0;
      double transfer = heat_transfer_coefficient(
          *campaign_.heat,
          {gas_mass_flow_ / area, gas_viscosity_, campaign_.scene.gas->prandtl, gas_conductivity_, 1 - charge_.packing},
          species.diameter);
      if (campaign_.heat->intragrain_resistance) {
        transfer = transfer_with_intragrain_resistance(
            transfer, species.diameter, species.conductivity.mean(campaign_.charging.temperature, gas_temperature_));
      }
      exchange.gas.push_back(transfer * 6 * charge_.packing * share / species.diameter * area);
    }
    if (kinds_.size() == 2 && present[0] && present[1]) exchange.between_solids = layers(area) * area;
    if (campaign_.scene.heat_loss) {
      exchange.wall = campaign_.scene.heat_loss->coefficient * wall_perimeter(campaign_, z);
    }
    return exchange;
  }

 private:
  [[nodiscard]] double layers(double area) const {
    if (!charged_in_layers(campaign_)) return 0;
    const double stretch = charge_.area / area;
    const auto conductivity = [&](std::size_t i) {
      const Species& species = campaign_.species[i];
      return bed_conductivity_carson(species.conductivity.mean(campaign_.charging.temperature, gas_temperature_),
                                     charge_.packing);
    };
    return layer_exchange(charge_.layer_thickness[kinds_[0]] * stretch, conductivity(kinds_[0]),
                          charge_.layer_thickness[kinds_[1]] * stretch, conductivity(kinds_[1]));
  }

  const Campaign& campaign_;
  const Charge& charge_;
  const std::vector<std::size_t>& kinds_;
  double gas_mass_flow_, gas_temperature_, gas_viscosity_, gas_conductivity_;
};

/// Over what a species goes through: from the charge's temperature to its melting (latent heat included), or to the
/// blast's.
double mean_heat_capacity(const Campaign& campaign, const Species& species, double gas_temperature) {
  const double from = campaign.charging.temperature;
  const double to = species.softening ? species.softening->melted : gas_temperature;
  if (to <= from) return species.heat_capacity.at(from);
  return (solid_enthalpy(species, to) - solid_enthalpy(species, from)) / (to - from);
}

}  // namespace

double inlet_height(const Campaign& campaign) {
  double flow = 0, moment = 0;
  if (campaign.scene.gas) {
    for (const Inlet& inlet : campaign.scene.gas->inlets) {
      flow += inlet.mass_flow;
      moment += inlet.mass_flow * (inlet.side == Inlet::Side::bottom ? campaign.bottom() : inlet.z);
    }
  }
  return flow > 0 ? moment / flow : campaign.bottom();
}

std::optional<HeatBalance> heat_balance(const Campaign& campaign, const Charge& charge) {
  if (!campaign.heat || !campaign.scene.gas || charge.total_mass_rate() <= 0) return std::nullopt;
  const Gas& gas = *campaign.scene.gas;
  HeatBalance result;
  for (const Inlet& inlet : gas.inlets) {
    result.gas_mass_flow += inlet.mass_flow;
    result.gas_temperature += inlet.mass_flow * inlet.total_temperature;
  }
  result.gas_enters_at_height = inlet_height(campaign);
  const double stock_line = campaign.charging.stock_line;
  if (result.gas_mass_flow <= 0 || stock_line <= result.gas_enters_at_height) return std::nullopt;
  result.gas_temperature /= result.gas_mass_flow;
  const GasState properties(gas);
  const double cooled = result.gas_temperature - campaign.charging.temperature;
  const double mean_capacity =
      cooled != 0
          ? (properties.enthalpy(result.gas_temperature) - properties.enthalpy(campaign.charging.temperature)) / cooled
          : properties.heat_capacity(result.gas_temperature);
  result.gas_heat_capacity_flow = result.gas_mass_flow * mean_capacity;

  for (std::size_t i = 0; i < campaign.species.size(); ++i) {
    if (charge.mass_rate[i] > 0) result.kinds.push_back(i);
  }
  CounterCurrentBed bed;
  for (const std::size_t i : result.kinds) {
    const Species& species = campaign.species[i];
    DescendingSolids solids;
    solids.heat_capacity_flow = charge.mass_rate[i] * mean_heat_capacity(campaign, species, result.gas_temperature);
    solids.charged_at = campaign.charging.temperature;
    if (species.softening) {
      solids.melts_at = species.softening->melted;
      solids.none_below = stock_line - std::max(species.none_below, result.gas_enters_at_height);
    }
    result.solids_heat_capacity_flow += solids.heat_capacity_flow;
    bed.solids.push_back(solids);
  }
  bed.length = stock_line - result.gas_enters_at_height;
  bed.gas_heat_capacity_flow = result.gas_heat_capacity_flow;
  bed.gas_enters_at = result.gas_temperature;
  if (campaign.scene.heat_loss) bed.wall_temperature = campaign.scene.heat_loss->ambient;
  const CampaignExchange exchange(campaign, charge, result.kinds, result.gas_mass_flow, result.gas_temperature);
  bed.exchange = [&](double depth, const std::vector<bool>& present) { return exchange(stock_line - depth, present); };
  result.profile = solve_counter_current_bed(bed);
  result.top_gas_temperature = result.profile.gas_temperature.front();

  const std::size_t count = campaign.species.size();
  result.transfer_units.assign(count, 0);
  result.melting_height.resize(count);
  result.softening_height.resize(count);
  result.leaves_at.assign(count, campaign.charging.temperature);
  const auto& depth = result.profile.depth;
  for (std::size_t k = 0; k < result.kinds.size(); ++k) {
    const std::size_t i = result.kinds[k];
    for (std::size_t n = 1; n < depth.size(); ++n) {
      const double middle = (depth[n] + depth[n - 1]) / 2;
      result.transfer_units[i] += bed.exchange(middle, present_at(middle, result.profile.end_depth)).gas[k] *
                                  (depth[n] - depth[n - 1]) / bed.solids[k].heat_capacity_flow;
    }
    result.leaves_at[i] = result.profile.solids_temperature[k].back();
    if (const auto& melts = result.profile.melting_depth[k]) result.melting_height[i] = stock_line - *melts;
    if (const auto& softening = campaign.species[i].softening) {
      if (const auto softens = result.profile.depth_of(k, softening->from)) {
        result.softening_height[i] = stock_line - *softens;
      }
    }
  }
  return result;
}

}  // namespace cupola
