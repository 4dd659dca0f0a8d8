#pragma once
#include <cstdint>
#include <vector>

#include "physics/mesh/bed_mesh.hpp"
#include "schemas/campaign.hpp"
#include "stage_tracer/cell_contents.hpp"
#include "stage_tracer/network.hpp"

namespace cupola {

/// Conduction through the solids (MODEL 16), implicit in time, on the spread contents of the cells:
/// * within a species, through each face with the conductance min(share) x harmonic mean of k_eff x area/distance,
///   k_eff after Carson, or Zehner, Bauer and Schluender, from the bed's solids fraction (non-orthogonality of the mesh
///   is left out);
/// * between two species in a cell, `layer_exchange` a volume from the recipe's layer thicknesses, weighted with
///   min(1, share_a share_b/(share_a share_b of the recipe)): whole where the cell holds the layers in the recipe's
///   proportions, none where it holds one species alone;
/// * `mixture` instead of both, for comparison: each species of a cell with each of the neighbour's, share x share x
///   Carson's k_eff of the volume-weighted conductivity.
/// Solids at walls lose heat where `walls.heat_loss.on` says so, each species on its share of the wall.
/// What leaves one place is what arrives at the other, whatever the solver's tolerance: the fluxes of the solution are
/// applied.
class Conduction {
 public:
  /// @param thickness mean layer thickness of each species, m; 0 for a species that is not charged
  /// @param recipe_share of each species in the charge's volume
  Conduction(const BedMesh& mesh, const Campaign& campaign, const std::vector<bool>& bed, std::vector<double> thickness,
             std::vector<double> recipe_share);

  struct Result {
    BySpecies change;   ///< K, [species][cell], of the spread mean temperatures
    BySpecies damping;  ///< of each place: share of its distance from the mean that a tracer there must give up
    double walls = 0;   ///< J, lost to the walls
    int iterations = 0;
  };
  /// The damping is (x - 1)/(x + 1) where x, the place's conductance times the step over its heat capacity, exceeds 1,
  /// else 0.  A tracer whose temperature changes by change + damping (mean - own) stays between the temperatures that
  /// conduct to it where x is large, whatever its own; where x is small it keeps its distance from the mean, as grains
  /// do.
  /// @param contents spread, each with its heat capacity  @param capacity J/K, [species][cell], spread with the same
  /// kernel
  /// @param bed_volume m3, [species][cell] (bed_composition)  @param step s
  [[nodiscard]] Result advance(const CellContents& contents, const BySpecies& capacity, const BySpecies& bed_volume,
                               double step) const;

  /// Steady temperatures of the cells in `free`, all others held: what infinitely long conduction and exchange with the
  /// gas leave there (stagnant solids, MODEL 12).  @param gas_conductance W/K a species and cell, to @param
  /// gas_temperature K.
  [[nodiscard]] BySpecies steady(const CellContents& contents, const BySpecies& bed_volume,
                                 const std::vector<bool>& free, const BySpecies& gas_conductance,
                                 const BySpecies& gas_temperature) const;

  /// Conductances between the places species x cells + cell, as they stand.
  /// @param contents spread
  [[nodiscard]] std::vector<Link> links(const CellContents& contents, const BySpecies& bed_volume) const;

 private:
  [[nodiscard]] BySpecies shares(const CellContents& contents, const BySpecies& bed_volume) const;
  /// k_eff, W/m/K, [species][cell].
  [[nodiscard]] BySpecies conductivities(const CellContents& contents, const BySpecies& bed_volume) const;
  void link_within_species(const BySpecies& share, const BySpecies& conductivity, std::vector<Link>& result) const;
  void link_layers(const BySpecies& share, const BySpecies& conductivity, std::vector<Link>& result) const;
  void link_mixture(const BySpecies& share, const BySpecies& conductivity, std::vector<Link>& result) const;
  /// To the outside, W/K, species x cells + cell.
  [[nodiscard]] std::vector<double> wall_conductance(const CellContents& contents, const BySpecies& bed_volume) const;

  const BedMesh& mesh_;
  const Campaign& campaign_;
  std::vector<bool> bed_;
  std::vector<double> thickness_;
  std::vector<double> recipe_share_;
  struct Neighbours {
    std::int64_t first, second;
    double area_over_distance;  ///< m
  };
  std::vector<Neighbours> neighbours_;
  std::vector<double> wall_;  ///< W/K, of the whole wall of each cell; empty where the solids lose nothing
};

}  // namespace cupola
