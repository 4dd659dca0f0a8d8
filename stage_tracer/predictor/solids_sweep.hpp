#pragma once
#include <vector>

#include "schemas/campaign.hpp"
#include "stage_tracer/cell_contents.hpp"
#include "stage_tracer/predictor/streamlines.hpp"
#include "stage_tracer/ranks.hpp"
#include "stage_tracer/removal.hpp"

namespace cupola {

/// What the solids meet on their way, arrays [species][cell]: dT/dt = rate (felt - T) + source.
struct SolidsSurroundings {
  BySpecies rate;    ///< 1/s, exchange with the gas over the heat capacity
  BySpecies felt;    ///< K, gas temperature as the species feels it
  BySpecies source;  ///< K/s, conduction
};

/// Steady solids on the streamlines.
struct SolidsOnLines {
  CellContents contents;  ///< volume in each cell and its mean temperature, as tracers would be found there
  Tally rates;            ///< mass, kg/s, and enthalpy, W, charged and leaving by cause
  /// Heat-capacity flow into each cell through each of its sides and from above the stock plane, W/K, [species][7 cell
  /// + side], side 6 being the stock plane.
  BySpecies inflow;
  /// Flow of the persistent species used up in each cell, m3/s.
  std::vector<double> removed;
  /// Volume of the lines' persistent flux at a storage of 1 that passed each cell, m3: the cell's own where lines fill
  /// it.
  std::vector<double> passed;
  /// Mean over that of the persistent species' share of the solids flux, f; 0 where nothing passed.
  std::vector<double> share;
};

/// Carries all species down the streamlines and integrates their temperatures exactly: in a stay the rate, the felt gas
/// temperature and the source are constant, so that T is an exponential, and its mean over those that survive the
/// raceways' removal is known in closed form.  Each line carries the species in the proportions of the charge; a
/// melting species ends within the stay in which it reaches its melting temperature, or where the line enters a cell
/// whose centre is below its `none_below`.  From there on the line's storage f alpha_p is that of what is left of it:
/// f follows the melting along the line itself, so that nothing jumps when the zone passes from one cell to the next.
/// What the gas and the sources give is what the enthalpy flows gain, to round-off.
class SolidsSweep {
 public:
  /// Keeps references. @param share of each species in the charge's volume
  SolidsSweep(const BedMesh& mesh, const Campaign& campaign, std::vector<double> share);

  /// Heat capacity of a volume of each species, J/m3/K: the mean from the charge's temperature to where the species
  /// melts (or to the hottest blast), latent heat included, so that what a melted grain has taken up is right.
  [[nodiscard]] const std::vector<double>& capacity() const { return capacity_; }

  /// @param packing solids fraction, all cells, not 0   @param sink of the persistent species, 1/s, all cells
  /// (raceways)
  [[nodiscard]] SolidsOnLines operator()(const Streamlines& lines, const std::vector<double>& packing,
                                         const std::vector<double>& sink, const SolidsSurroundings& surroundings,
                                         const SumOverRanks& sum) const;

 private:
  class Walk;

  const BedMesh& mesh_;
  const Campaign& campaign_;
  std::vector<double> share_over_persistent_;
  std::vector<bool> persistent_;
  std::vector<double> capacity_;
};

}  // namespace cupola
