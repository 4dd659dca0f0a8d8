#pragma once
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "physics/closures/inlet.hpp"
#include "physics/plan/bed_pressure.hpp"
#include "physics/plan/charge.hpp"
#include "physics/plan/cost.hpp"
#include "physics/plan/dem_time_step.hpp"
#include "physics/plan/heat_balance.hpp"
#include "physics/plan/mesh_counts.hpp"
#include "schemas/campaign.hpp"

namespace cupola {

/// One piece of physics, whether the scene needs it, and why.
struct PhysicsPiece {
  std::string name;
  bool on = false;
  std::string why;
  double core_seconds = 0;  ///< expected, an episode; zero where it has no cost of its own, or is off
};

struct SpeciesPlan {
  std::string name;
  double parcel_diameter = 0;    ///< m
  double grains_per_parcel = 0;  ///< coarse graining cubed
  double parcels = 0;            ///< expected in the bed
  [[nodiscard]] double grains() const { return parcels * grains_per_parcel; }
};

struct InletPlan {
  std::string name;
  double opening = 0;  ///< m2
  InletState state;
};

struct MeshPlan {
  MeshCounts counts;
  double volume = 0;                           ///< m3
  double shortest_edge = 0, longest_edge = 0;  ///< m, of the cells' heights, depths and mean widths
};

/// What follows from a campaign before anything is run: `cupola explain`.
struct Plan {
  std::string campaign;
  std::vector<PhysicsPiece> physics;
  MeshPlan mesh;
  double bed_volume = 0;  ///< m3, below the stock line
  double hopper_top = 0;  ///< m, where the DEM domain ends
  std::vector<SpeciesPlan> species;
  Charge charge;
  double dem_speed_up = 0;
  DemTimeStep dem_step;
  std::vector<InletPlan> inlets;
  std::optional<BedPressure> pressure;
  std::optional<HeatBalance> heat;
  Cost cost;
  std::vector<std::string> warnings;
  std::vector<std::string> refusals;  ///< reasons not to run it at all; `refuse` throws them
  double stock_line = 0;              ///< m, to turn depths of `heat->profile` into heights
};

/// @throws Failure wrong_input where the mesh does not hold the campaign
Plan make_plan(const Campaign& campaign, const Rates& rates = {});

/// @throws Failure wrong_input with all refusals of a plan, if there are any
void refuse(const Plan& plan);

/// For people: what `cupola explain` prints.
std::string plan_text(const Plan& plan);

/// The same for programs, SI units; `heat.profile` has at most 200 heights.
nlohmann::json plan_json(const Plan& plan);

}  // namespace cupola
