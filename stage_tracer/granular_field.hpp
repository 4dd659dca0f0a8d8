#pragma once
#include <cstdint>
#include <vector>

#include "physics/mesh/bed_mesh.hpp"
#include "physics/motion/path.hpp"
#include "physics/plan/charge.hpp"
#include "schemas/campaign.hpp"

namespace cupola {

/// A face through which the bed is charged.
struct StockFace {
  std::int64_t face = -1;
  std::int64_t cell = -1;  ///< bed cell behind it
  double volume_rate = 0;  ///< m3/s, material volume of all species
};

/// The granular field that moves the tracers (MODEL 3, 8, 12): once an episode, at process speed.  Arrays over all
/// cells or faces.
///
/// The persistent species are those that do not melt (coke); they alone reach the raceways, and their volume flux q = f
/// alpha_p u_p has known sources and sinks.  All species move with u_p = q/(f alpha_p).
struct GranularField {
  std::vector<bool> bed;                 ///< cells below the stock plane
  std::vector<double> solids_fraction;   ///< alpha_p, material volume
  std::vector<double> contact_fraction;  ///< contact volume
  std::vector<double> storage;           ///< f alpha_p, positive
  std::vector<double> face_flux;         ///< q through each face, out of its owner, m3/s
  std::vector<double> removal_rate;      ///< 1/s: probability of removal a second of a tracer in the cell (raceways)
  std::vector<bool> stagnant;            ///< scaled residence above ten bed passages
  std::vector<StockFace> stock_faces;
  Charge charge;                    ///< at the packing found near the stock plane (MODEL 3)
  double scale = 1;                 ///< process speed over DEM speed
  double scale_check = 0;           ///< persistent flux through mid-shaft over DEM removal, minus 1
  double storage_over_removal = 0;  ///< of the DEM window
  double error_before = 0, error_after = 0, change = 0;  ///< of the cleaning (CleanGranularField)
};

/// Least solids fraction that motion divides by; cells below it (raceways, ragged surface) count with this value.
inline constexpr double least_solids_fraction = 0.05;

/// Which species never melt.
std::vector<bool> persistent_species(const Campaign& campaign);

/// What is charged of all species, and the persistent species' part of it.
struct ChargedFlux {
  double volume_rate = 0;           ///< m3/s, material volume of all species
  double persistent_share = 0;      ///< in that volume
  double persistent_mass_rate = 0;  ///< kg/s
};
ChargedFlux charged_flux(const Campaign& campaign, const Charge& charge);

/// Packing (material volume fraction) of the bed's upper part: the mean between one and three thickest layers below the
/// stock plane, or of the upper half where the bed is lower than that.
double packing_near_stock(const BedMesh& mesh, const Campaign& campaign, const std::vector<bool>& bed,
                          const std::vector<double>& solids_fraction);

/// f: share of the persistent species in the solids flux (MODEL 8): the charge's where the melting species has not
/// melted, 1 where it has and below the height under which none of it may be.  Softened ore keeps its mass, and with it
/// its part of the flux, until it melts: a share that rose with the degree of softening would count it as coke.
/// @param ore_temperature K, all cells: what the DEM stage softened and melted by; empty in a scene without heat
std::vector<double> persistent_share(const BedMesh& mesh, const Campaign& campaign, double charged_share,
                                     const std::vector<double>& ore_temperature);

/// Sink of persistent volume in the raceways, 1/s, all cells: `total` (m3/s) split among the raceways by `weights` and
/// within each by cell volume.
/// @throws Failure wrong_input where a raceway's box holds no bed cell
std::vector<double> raceway_sink(const BedMesh& mesh, const Campaign& campaign, const std::vector<bool>& bed,
                                 const std::vector<double>& weights, double total);

/// How the raceways share the sink: as the DEM stage's removed, where that is known and not 0, otherwise as the
/// campaign (which has raceways) states their rates.
std::vector<double> raceway_weights(const Campaign& campaign, const std::vector<double>& removal_by_raceway);

/// Face fluxes of a cell field by linear interpolation, none through walls: the field as it is, without cleaning.
std::vector<double> interpolate_flux(const BedMesh& mesh, const std::vector<bool>& bed,
                                     const std::vector<Vector3>& flux);

/// The faces of the stock plane with an inflow, each with its share of `volume_rate` (all species).
/// @throws Failure wrong_input where nothing flows in
std::vector<StockFace> stock_faces(const BedMesh& mesh, const std::vector<bool>& bed,
                                   const std::vector<double>& face_flux, double volume_rate);

/// MODEL 12: bed cells in which solids stay longer than ten passages of the bed's height at the descent rate.
std::vector<bool> stagnant_cells(const BedMesh& mesh, const Campaign& campaign, const GranularField& field);

}  // namespace cupola
