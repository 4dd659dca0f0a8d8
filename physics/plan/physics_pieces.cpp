#include "physics/plan/physics_pieces.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "physics/closures/drag.hpp"
#include "schemas/campaign_words.hpp"

namespace cupola {

namespace {

std::string convection_piece(const Heat& heat) {
  const char* law = heat.convection == Heat::Convection::gunn    ? "Gunn"
                    : heat.convection == Heat::Convection::wakao ? "Wakao"
                                                                 : "Ranz-Marshall";
  return fmt::format("{} x {}", law, heat.nusselt_factor);
}

std::string conduction_piece(const Heat& heat) {
  switch (heat.bed_conduction) {
    case Heat::BedConduction::zehner_bauer_schluender:
      return fmt::format("Zehner-Bauer-Schluender with radiation, emissivity {}", heat.emissivity);
    case Heat::BedConduction::mixture:
      return "mixture of gas and grains by volume";
    case Heat::BedConduction::carson:
      break;
  }
  return "Carson";
}

std::string dem_gas_piece(const Campaign& campaign) {
  const auto drag = drag_law_name(campaign.drag);
  switch (campaign.dem.gas) {
    case DemSettings::GasModel::frozen:
      return fmt::format("frozen, {} drag: solved once through the settled bed (dem.gas is frozen)", drag);
    case DemSettings::GasModel::transient:
      return fmt::format("transient, compressible, {} drag: the bed moves with the gas (dem.gas is transient)", drag);
    default:
      return fmt::format("quasi-steady, {} drag: the gas adapts faster than the bed moves, one solution a block", drag);
  }
}

}  // namespace

std::vector<PhysicsPiece> physics_pieces(const Campaign& campaign, const Cost::Parts& cost) {
  const bool gas = campaign.scene.gas.has_value();
  const bool heat = campaign.heat.has_value();
  const bool dem_gas = gas && campaign.dem.gas != DemSettings::GasModel::none;
  const bool tracer_gas = gas && campaign.tracer.gas != TracerSettings::GasModel::none;
  const bool layered = charged_in_layers(campaign) && campaign.species.size() > 1;
  const bool softens = std::any_of(campaign.species.begin(), campaign.species.end(),
                                   [](const Species& species) { return species.softening.has_value(); });
  const bool coarse = std::any_of(campaign.species.begin(), campaign.species.end(),
                                  [](const Species& species) { return species.coarse_graining != 1; });
  const char* no_gas = "the scene has no gas (scene.gas)";
  const char* cold = "the scene is cold (no heat section)";

  std::vector<PhysicsPiece> pieces;
  const auto piece = [&](std::string name, bool on, std::string why, double core_seconds = 0) {
    pieces.push_back({std::move(name), on, std::move(why), core_seconds});
  };
  piece("contacts", true,
        campaign.contacts.model == Contacts::Model::hertz ? "Hertz with tangential history"
                                                          : "linear spring with tangential history",
        cost.contacts);
  piece("coarse graining", coarse,
        coarse ? "parcels stand for several grains (species.coarse_graining)" : "every grain is a parcel");
  piece("gas in the DEM stage", dem_gas, dem_gas ? dem_gas_piece(campaign) : (gas ? "dem.gas is none" : no_gas),
        cost.dem_gas);
  const bool transient = dem_gas && campaign.dem.gas == DemSettings::GasModel::transient;
  const bool turbulent = transient && campaign.dem.transient.turbulence != TransientGas::Turbulence::laminar;
  piece("turbulence of the gas", turbulent,
        turbulent ? fmt::format("{} of OpenFOAM in the DEM stage's transient gas (dem.transient.turbulence)",
                                words::word_of(words::turbulence, campaign.dem.transient.turbulence))
                  : (transient ? "dem.transient.turbulence is laminar"
                               : "only the transient gas of the DEM stage can be turbulent (dem.gas)"));
  const bool filtered = gas && campaign.filtered_drag.has_value();
  piece("drag of coarse parcels and cells", filtered,
        !gas ? no_gas
             : (filtered ? fmt::format("parcel coefficient {}, clusters smaller than a cell {}",
                                       campaign.filtered_drag->parcel_coefficient,
                                       campaign.filtered_drag->grid ? "corrected" : "not corrected")
                         : "filtered_drag is absent"));
  piece("dead man", campaign.dead_man.has_value(),
        campaign.dead_man
            ? fmt::format("coke below z = {} m - {} |x| stands still", campaign.dead_man->tip, campaign.dead_man->slope)
            : "dead_man is absent");
  const bool smoothed = campaign.dem.void_fraction == DemSettings::VoidFraction::smoothed;
  piece("smoothed void fraction", smoothed,
        smoothed ? fmt::format("over {} m in the DEM stage", campaign.dem.smoothing_length)
                 : "dem.void_fraction is divided: parcels are shared out over the cells they lie in");
  piece("motion of the tracers", true, "along the granular field of the DEM stage", cost.motion);
  piece("gas in the tracer stage", tracer_gas,
        tracer_gas ? fmt::format("{}, {} drag",
                                 campaign.tracer.gas == TracerSettings::GasModel::navier_stokes ? "Navier-Stokes"
                                                                                                : "Darcy-Forchheimer",
                                 drag_law_name(campaign.drag))
                   : (gas ? "tracer.gas is none" : no_gas),
        cost.gas_flow);
  piece("gas energy", heat && tracer_gas,
        heat ? (tracer_gas ? "steady, with what the solids exchange" : "no gas in the tracer stage") : cold,
        cost.gas_energy);
  piece("heat between gas and solids", heat && tracer_gas,
        heat ? (tracer_gas ? convection_piece(*campaign.heat) : "no gas in the tracer stage") : cold, cost.exchange);
  const bool intragrain = heat && campaign.heat->intragrain_resistance;
  piece("resistance inside the grain", intragrain,
        !heat ? cold : (intragrain ? "Biot correction of the exchange" : "heat.intragrain_resistance is off"));
  piece("gas conduction", heat && tracer_gas,
        heat ? (tracer_gas ? "Syamlal-Gidaspow" : "no gas in the tracer stage") : cold);
  piece("conduction within a species", heat, heat ? conduction_piece(*campaign.heat) : cold, cost.conduction);
  piece("exchange between layers", heat && layered,
        !heat ? cold : (layered ? "layers of different species touch" : "no layers of single species"));
  const bool loss = heat && campaign.scene.heat_loss.has_value();
  piece("wall heat loss", loss,
        !heat ? cold
              : (loss ? fmt::format("{} W/m2/K to {} K", campaign.scene.heat_loss->coefficient,
                                    campaign.scene.heat_loss->ambient)
                      : "scene.walls.heat_loss is absent"));
  piece("softening and melting", heat && softens,
        !heat ? cold : (softens ? "a species softens (species.softening)" : "no species softens"));
  const bool latent = heat && std::any_of(campaign.species.begin(), campaign.species.end(), [](const Species& species) {
                        return species.softening && species.softening->latent_heat > 0;
                      });
  piece("latent heat of melting", latent,
        !heat ? cold : (latent ? "taken up between softening and melting" : "no species.softening.latent_heat"));
  const bool rings = std::any_of(campaign.charging.rings.begin(), campaign.charging.rings.end(),
                                 [](const auto& ring) { return ring.has_value(); });
  piece("charging rings", rings,
        rings ? "layers laid between two |x| (charging.layers.ring)" : "layers over the whole width");
  piece(
      "raceways", !campaign.raceways.empty(),
      campaign.raceways.empty() ? "none given" : fmt::format("{} boxes that take coke away", campaign.raceways.size()));
  const bool periodic = campaign.scene.geometry.sides == Geometry::Sides::periodic;
  piece("periodic front and back", periodic, periodic ? "scene.geometry.slot.sides" : "front and back are walls");
  piece("cleaned granular field", campaign.tracer.clean_field,
        campaign.tracer.clean_field
            ? fmt::format("{} smoothing passes and a projection", campaign.tracer.smoothing_passes)
            : "tracer.clean_field is off");
  const bool random = campaign.tracer.displacement != TracerSettings::Displacement::none;
  piece("random displacement of tracers", random,
        random ? "tracer.displacement" : "the cleaned field keeps the packing by itself");
  return pieces;
}

}  // namespace cupola
