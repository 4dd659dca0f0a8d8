#pragma once
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "schemas/property_curve.hpp"

/// The campaign file as a typed value, SI throughout, nothing left open.  One struct a section of the YAML file, one
/// member a key, same names.  `read_campaign` (campaign_reader.hpp) makes it; `resolved_yaml` (resolved_campaign.hpp)
/// writes it back.
namespace cupola {

using Vector3 = std::array<double, 3>;

/// `scene.geometry`: a slot or box, mirror-symmetric in x, extruded in y (|y| <= depth/2).
struct Geometry {
  enum class Kind { slot, box };
  enum class Sides { periodic, walls };
  Kind kind = Kind::slot;
  double depth = 0;               ///< m, along y
  Sides sides = Sides::periodic;  ///< front and back
  std::vector<std::array<double, 2>>
      profile;  ///< (z, half width) in m, z rising; a box has two entries of one half width
};

/// Exact cell counts, where the wanted edge length is not enough.
struct MeshCells {
  int half_width = 0;        ///< from x = 0 to the wall
  int depth = 0;             ///< along y
  std::vector<int> heights;  ///< one a section of the profile, from the bottom up
};

struct MeshSettings {
  double cell = 0;  ///< m, wanted cell edge; with `cells` given the mean cell height, for criteria in cells
  std::optional<MeshCells> cells;  ///< given: these counts, and `cell` does not shape the mesh
};

/// A gas inlet: an opening in a side wall (a tuyere, centred at y = 0 and at `z`), or the whole bottom.
struct Inlet {
  enum class Side { left, right, bottom };
  enum class Given { mass_flow, velocity, pressure };
  std::string name;
  Side side = Side::left;
  double z = 0;                      ///< m, centre of the opening; unused for `bottom`
  std::array<double, 2> size{0, 0};  ///< m: extent along y, extent along the wall's height; unused for `bottom`
  Given given = Given::mass_flow;    ///< which of the next three the campaign states; the others are 0
  double mass_flow = 0;              ///< kg/s
  double velocity = 0;               ///< m/s, mean in the opening
  double pressure = 0;               ///< Pa, static, absolute, in the opening
  double total_temperature = 293;    ///< K
};

/// Sutherland's formula for the viscosity of a gas.
struct Sutherland {
  double viscosity = 0;  ///< Pa s, at the temperature `at`
  double at = 0;         ///< K
  double constant = 0;   ///< K
};

/// Polynomials of the heat capacity, enthalpy and entropy of an ideal gas, as in the JANAF and NASA tables (7
/// coefficients).
struct JanafPolynomials {
  double from = 0;    ///< K
  double common = 0;  ///< K, where the two ranges meet
  double to = 0;      ///< K
  std::array<double, 7> low{};
  std::array<double, 7> high{};
};

struct Gas {
  enum class ViscosityModel { constant, sutherland };
  enum class HeatCapacityModel { constant, janaf };
  std::string species;       ///< a preset (`air`, `nitrogen`, `blast`) or a name for the report
  double molar_mass = 0;     ///< kg/mol
  double heat_capacity = 0;  ///< J/kg/K, at constant pressure (heat_capacity_model constant)
  double viscosity = 0;      ///< Pa s (viscosity_model constant)
  double prandtl = 0;        ///< 1
  std::vector<Inlet> inlets;
  double outlet_pressure = 1e5;  ///< Pa
  ViscosityModel viscosity_model = ViscosityModel::constant;
  Sutherland sutherland;
  HeatCapacityModel heat_capacity_model = HeatCapacityModel::constant;
  JanafPolynomials janaf;
};

struct WallHeatLoss {
  enum class On { gas, solids, both };
  double coefficient = 0;  ///< W/m2/K
  double ambient = 293;    ///< K
  On on = On::gas;         ///< both: the gas by the void fraction, the solids by the rest of the wall's area
};

struct Scene {
  Geometry geometry;
  MeshSettings mesh;
  std::optional<Gas> gas;                 ///< none: a scene without gas
  std::optional<WallHeatLoss> heat_loss;  ///< `walls.heat_loss`
};

struct Softening {
  double from = 0;         ///< K, softening begins
  double melted = 0;       ///< K, the grain has melted and is removed
  double latent_heat = 0;  ///< J/kg, taken up evenly between the two temperatures
};

struct Species {
  std::string name;
  double diameter = 0;          ///< m, of the grain
  double coarse_graining = 1;   ///< parcel diameter over grain diameter
  double density = 0;           ///< kg/m3
  PropertyCurve heat_capacity;  ///< J/kg/K, over the temperature, without latent heat
  PropertyCurve conductivity;   ///< W/m/K, of the grain, over the temperature
  std::optional<Softening> softening;
  double none_below = 0;  ///< m; a softening species that gets below this height is removed and counted as unmelted

  [[nodiscard]] double parcel_diameter() const { return diameter * coarse_graining; }
};

/// Contact of a pair of species, or of a species with the wall.
struct ContactPair {
  double restitution = 0.5;
  double friction = 0.5;
  double rolling = 0.02;
};

struct Contacts {
  enum class Model { hertz, linear_spring };
  enum class Rolling { none, cdt, epsd, epsd2 };
  enum class StiffnessOf { grain, parcel };
  Model model = Model::hertz;
  Rolling rolling_model = Rolling::epsd;
  double youngs_modulus = 5e7;       ///< Pa (hertz)
  double wall_youngs_modulus = 5e6;  ///< Pa (hertz)
  double poisson_ratio = 0.25;
  double rolling_damping = 0.3;                   ///< of critical, of the rolling spring (epsd)
  double stiffness = 0;                           ///< N/m (linear-spring)
  StiffnessOf stiffness_of = StiffnessOf::grain;  ///< what `stiffness` belongs to: the parcel's is n times the grain's
  double tangential_ratio = 2.0 / 7;              ///< tangential over normal stiffness (linear-spring)
  std::map<std::string, ContactPair>
      pairs;  ///< "coke-coke", "coke-ore", "coke-wall", …; species names in the order of `species`

  /// What `stiffness` is multiplied with to be a parcel's, N/m.
  [[nodiscard]] double stiffness_factor(double coarse_graining) const {
    return stiffness_of == StiffnessOf::grain ? coarse_graining : 1;
  }
};

enum class DragLaw { ergun, wen_yu, gidaspow, di_felice, koch_hill, beetstra, emms };

/// `filtered_drag`: what coarse parcels and coarse cells do not resolve, a factor on the drag law.
struct FilteredDrag {
  double parcel_coefficient = 0;  ///< k of the parcel correction exp(-k (n - 1)), n the coarse graining
  bool grid = true;               ///< correction for clusters smaller than a cell
};

/// Present only where heat is on.
struct Heat {
  enum class Convection { ranz_marshall, gunn, wakao };
  enum class BedConduction { carson, zehner_bauer_schluender, mixture };
  double nusselt_factor = 1;
  Convection convection = Convection::ranz_marshall;
  BedConduction bed_conduction = BedConduction::carson;
  double emissivity = 0.8;             ///< of the grains (zehner-bauer-schluender)
  bool intragrain_resistance = false;  ///< Biot correction of the heat transfer coefficient
};

/// Guessed cohesive zone: z = tip - slope |x|; below it one temperature, above it another.
struct InvertedV {
  double tip = 0;    ///< m
  double slope = 0;  ///< 1
  double below = 0;  ///< K
  double above = 0;  ///< K
};

struct Initial {
  std::optional<InvertedV> cohesive_zone;
};

/// One charged layer: mass by species, kg.
using Layer = std::map<std::string, double>;

struct Charging {
  double stock_line = 0;      ///< m; a layer is charged when the bed's surface falls below it
  std::vector<Layer> layers;  ///< the recipe, repeated
  std::vector<std::optional<std::array<double, 2>>>
      rings;                 ///< m: |x| that each layer is laid between; absent (or no entry): the whole width
  double temperature = 293;  ///< K of the charge
  double hopper_height =
      0;  ///< m, DEM domain above the mesh top; default: thickest layer (mass/density/0.55) plus 0.5 m

  /// The ring of a layer; none where it covers the whole width.
  [[nodiscard]] std::optional<std::array<double, 2>> ring_of(std::size_t layer) const {
    return layer < rings.size() ? rings[layer] : std::nullopt;
  }
};

struct Raceway {
  enum class Removal { rate, keep_void };
  std::array<Vector3, 2> box{};  ///< m, lower and upper corner
  double void_fraction = 0.75;   ///< `void`: least void fraction the gas sees in the box
  double dem_removal_rate = 0;   ///< kg/s in the DEM stage; the most that is taken where a void is kept
  Removal removal = Removal::rate;
};

/// Coke that stands still in the DEM stage: a wedge at the bottom, below z = tip - slope |x|.
struct DeadMan {
  double tip = 0;    ///< m, height at x = 0
  double slope = 1;  ///< 1, fall of its flanks over |x|

  [[nodiscard]] bool contains(const Vector3& point) const { return point[2] < tip - slope * std::abs(point[0]); }
};

/// `dem.limits`: a run that exceeds one of them stops.
struct DemLimits {
  double overlap = 0.3;       ///< of two parcels, over the smaller radius
  double wall_overlap = 0.6;  ///< of a parcel and a wall, over its radius
  double creep = 0.25;        ///< sinking of the bed at rest over its descent in the DEM stage
};

/// `dem.transient`: steps of the transient gas.
struct TransientGas {
  enum class Turbulence { laminar, k_epsilon, rng_k_epsilon, realizable_k_epsilon };
  std::optional<double>
      time_step;         ///< s, at most; absent: a block, cut by the gas's way through a cell and by the drag
  double courant = 0.5;  ///< largest way of the gas in a step, in cells
  int corrections = 2;   ///< of a whole step: density and drag, then pressure and fluxes (PIMPLE's outer ones)
  Turbulence turbulence = Turbulence::laminar;
};

struct DemSettings {
  enum class GasModel { none, frozen, quasi_steady, transient };
  enum class Stop { fields_converged, duration };
  enum class VoidFraction { divided, smoothed };
  std::string engine = "liggghts";
  GasModel gas = GasModel::quasi_steady;
  Stop stop = Stop::duration;       ///< `stop.when`
  double at_most = 20;              ///< s, `stop.at_most`
  double relaxation = 1;            ///< s, before the averaging window begins
  double window = 2;                ///< s, averaging window (the shortest one where stop is fields-converged)
  double standard_error = 0.05;     ///< wanted relative standard error of |u_p| (fields-converged)
  std::optional<double> time_step;  ///< s; absent: auto
  double rayleigh_fraction = 0.05;  ///< of the Rayleigh time (hertz) or collision time (linear-spring), for `auto`
  double block = 0.05;              ///< s, coupling block: gas, removal, charging and checkpoints happen between blocks
  VoidFraction void_fraction = VoidFraction::divided;  ///< how parcels are spread over cells
  double smoothing_length = 0;                         ///< m, width of the smoothing (smoothed)
  TransientGas transient;
  DemLimits limits;
};

/// Where tracers are not displaced (`tracer.displacement_excludes`).
struct DisplacementExcludes {
  bool above_cohesive_zone = true;            ///< unmolten cells above `none_below`, where layers are to be kept
  std::vector<std::array<Vector3, 2>> boxes;  ///< m, lower and upper corner
};

struct TracerSettings {
  enum class GasModel { none, darcy_forchheimer, navier_stokes };
  enum class Displacement { none, random, relaxation, random_and_relaxation };
  enum class Stop { duration, steady };
  enum class Resolve { automatic, every_step };
  double duration = 3600;           ///< s
  Stop stop = Stop::duration;       ///< `stop.when`
  double at_most = 3600;            ///< s, `stop.at_most` (steady): longest process time; default: `duration`
  double remaining_change = 0.01;   ///< `stop.remaining_change` (steady), over rms(T - 293 K); default: `accuracy`
  std::optional<double> time_step;  ///< s; absent: auto
  GasModel gas = GasModel::darcy_forchheimer;
  bool compare_gas_models = false;  ///< solve the last state with both and report the difference
  double accuracy = 0.01;           ///< wanted relative error
  double tracers_per_cell = 4;      ///< at least
  bool clean_field = true;          ///< smooth and project the granular field (docs: cleaning)
  int smoothing_passes = 4;
  Displacement displacement = Displacement::none;
  double displacement_coefficient = 5e-4;  ///< m2/s, D0 of the random displacement
  double displacement_limit = 0.05;        ///< m, largest random displacement a step
  double relaxation_coefficient = 0.1;     ///< m2/s, D0 of the relaxation along the gradient
  double relaxation_limit = 0.01;          ///< m, largest relaxation a step
  DisplacementExcludes displacement_excludes;
  Resolve resolve = Resolve::automatic;  ///< when the gas flow is solved again

  /// Process time the stage marches, at most, s.
  [[nodiscard]] double longest() const { return stop == Stop::steady ? at_most : duration; }
};

enum class Strategy { march, predict_and_verify };

/// How `strategy: predict-and-verify` verifies.
struct PredictAndVerify {
  int windows = 6;  ///< layer passages that tracers are marched in an episode; the first is not looked at
};

struct Converged {
  double temperature = 0.01;           ///< remaining change over rms(T - 293 K)
  double cohesive_zone_cells = 1;      ///< `cohesive_zone`, in cells
  double granular_velocity_sigma = 2;  ///< `granular_velocity`, in standard errors
  int for_episodes = 2;                ///< `for`
  int at_most = 8;                     ///< episodes
};

/// Each stage is a job of a Slurm cluster.
struct SlurmLaunch {
  enum class Starter { mpirun, srun };
  double time = 0;                    ///< s, limit of a job
  double checkpoint_before = 0;       ///< s before the limit, when the stage is asked for its checkpoint
  std::string partition;              ///< empty: the cluster's default
  std::string account;                ///< empty: the user's default
  std::string qos;                    ///< empty: the user's default
  int nodes = 0;                      ///< 0: as Slurm places the ranks
  Starter starter = Starter::mpirun;  ///< of the ranks in a job
  std::vector<std::string> options;   ///< further ones of sbatch
  std::vector<std::string> setup;     ///< shell lines before the stage
};

struct Launch {
  int ranks = 1;                     ///< of each stage, here or in `slurm`
  std::optional<SlurmLaunch> slurm;  ///< none: on this machine
};

struct Campaign {
  std::string name;  ///< `campaign`
  Scene scene;
  std::vector<Species> species;  ///< in the order of the file
  Contacts contacts;
  DragLaw drag = DragLaw::gidaspow;
  std::optional<FilteredDrag> filtered_drag;
  std::optional<Heat> heat;
  Initial initial;
  Charging charging;
  std::vector<Raceway> raceways;
  std::optional<DeadMan> dead_man;
  double descent_rate = 0;  ///< m/s, downwards, at the stock line
  DemSettings dem;
  TracerSettings tracer;
  Strategy strategy = Strategy::march;
  PredictAndVerify predict_and_verify;
  Converged converged;
  Launch launch;
  std::uint64_t random_seed = 1;

  /// Index of a species by name. @throws std::out_of_range
  [[nodiscard]] std::size_t species_index(const std::string& wanted) const;
  /// Half width of the profile at height z (the end values beyond the ends), m.
  [[nodiscard]] double half_width(double z) const;
  /// Lowest and highest z of the profile, m: the ends of the mesh.
  [[nodiscard]] double bottom() const { return scene.geometry.profile.front()[0]; }
  [[nodiscard]] double top() const { return scene.geometry.profile.back()[0]; }
  /// Top of the charging hopper, where the DEM domain ends, m.
  [[nodiscard]] double hopper_top() const { return top() + charging.hopper_height; }
};

}  // namespace cupola
