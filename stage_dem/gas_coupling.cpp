#include "stage_dem/gas_coupling.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "physics/closures/drag.hpp"
#include "physics/closures/gas_properties.hpp"
#include "physics/gas/inlets_json.hpp"
#include "stage_dem/parcels.hpp"
#include "stage_dem/process_time.hpp"

namespace cupola {
namespace {

constexpr double void_change_allowed = 0.15;
constexpr double longest_between = 0.25;  // s
/// Relative change of the fluxes at which an iteration of the flow ends: the force needs no more.
constexpr double force_tolerance = 1e-2;
/// Interstitial speed below which the gas counts as at rest in the damping, m/s.
constexpr double least_speed = 0.01;

double norm(const double* v) { return std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]); }

/// rms over the cells with solids of the change of the void fraction.
double change_of_void(const std::vector<double>& now, const std::vector<double>& before,
                      const std::vector<double>& volume) {
  double sum = 0;
  std::size_t cells = 0;
  for (std::size_t cell = 0; cell < now.size(); ++cell) {
    if (volume[cell] <= 0) continue;
    sum += std::pow(now[cell] - before[cell], 2);
    ++cells;
  }
  return cells > 0 ? std::sqrt(sum / static_cast<double>(cells)) : 0;
}

}  // namespace

GasCoupling::GasCoupling(FoamCase& foam, const BedMesh& mesh, const Campaign& campaign,
                         std::vector<double> gas_temperature, MPI_Comm communicator)
    : mesh_(mesh),
      campaign_(campaign),
      communicator_(communicator),
      flow_(foam, mesh, campaign),
      temperature_(std::move(gas_temperature)) {}

void GasCoupling::update(const SolidsOnMesh& solids, const std::vector<Parcel>& /*owned*/, double seconds,
                         bool in_any_case) {
  bed_ = bed_state(mesh_, campaign_, solids.species_volume());
  cells_at_floor_ = bed_.cells_at_floor;
  seconds_since_ += seconds;
  const bool first = void_solved_.empty();
  if (!first && campaign_.dem.gas == DemSettings::GasModel::frozen) return;
  if (!first && !in_any_case && seconds_since_ < longest_between - same_time &&
      change_of_void(bed_.void_fraction, void_solved_, solids.volume()) < void_change_allowed)
    return;
  flow_.solve(bed_, temperature_, first ? 1e-4 : force_tolerance, first ? 100 : 10);
  void_solved_ = bed_.void_fraction;
  seconds_since_ = 0;
  ++solves_;
  pressure_ = flow_.pressure();
  const std::size_t cells = mesh_.cells();
  gradient_.resize(3 * cells);
  mass_flux_.resize(3 * cells);
  speed_.resize(cells);
  for (std::size_t cell = 0; cell < cells; ++cell) {
    for (std::size_t k = 0; k < 3; ++k) {
      gradient_[3 * cell + k] = flow_.pressure_gradient()[cell][k];
      mass_flux_[3 * cell + k] = flow_.mass_flux()[cell][k];
    }
    speed_[cell] = norm(&mass_flux_[3 * cell]) / density(cell) / bed_.void_fraction[cell];
  }
}

double GasCoupling::density(std::size_t cell) const {
  return gas_density(pressure_[cell], temperature_[cell], campaign_.scene.gas->molar_mass);
}

double GasCoupling::slip_damping(const Parcel& parcel, std::size_t cell, double solids_volume) const {
  const double void_fraction = bed_.void_fraction[cell];
  const double gas_density = density(cell);
  Vector3 slip{};
  for (std::size_t k = 0; k < 3; ++k)
    slip[k] = parcel.velocity[k] - mass_flux_[3 * cell + k] / gas_density / void_fraction;
  const double resistance =
      drag_resistance(campaign_.drag, void_fraction, bed_.grain_diameter[cell], campaign_.scene.gas->viscosity,
                      gas_density, void_fraction * norm(slip.data()), bed_.drag_factor[cell]);
  return material_volume(campaign_, parcel) * mesh_.cell_volume[cell] / solids_volume * void_fraction * resistance;
}

std::vector<ParcelForce> GasCoupling::forces(const SolidsOnMesh& solids, const std::vector<Parcel>& owned) {
  std::vector<ParcelForce> forces(owned.size());
  const auto& volume = solids.volume();
  std::array<double, 3> total{};
  // On a unit of material volume in each cell: -grad p/alpha_c, and its size over the gas's speed.
  std::array<std::vector<double>, 4> on_volume;
  on_volume.fill(std::vector<double>(mesh_.cells(), 0.0));
  for (std::size_t cell = 0; cell < mesh_.cells(); ++cell) {
    if (volume[cell] <= 0) continue;
    const double weight = mesh_.cell_volume[cell] / volume[cell];
    for (std::size_t k = 0; k < 3; ++k) on_volume[k][cell] = -weight * gradient_[3 * cell + k];
    on_volume[3][cell] = weight * norm(&gradient_[3 * cell]) / std::max(speed_[cell], least_speed);
  }
  for (auto& values : on_volume) solids.gather(values);
  for (std::size_t i = 0; i < owned.size(); ++i) {
    ParcelForce& force = forces[i];
    const double parcel_volume = material_volume(campaign_, owned[i]);
    for (const auto& [index, share] : solids.shares(i)) {
      const auto cell = static_cast<std::size_t>(index);
      for (std::size_t k = 0; k < 3; ++k) force.force[k] += parcel_volume * share * on_volume[k][cell];
      force.damping += parcel_volume * share * on_volume[3][cell];
    }
    const auto centre = static_cast<std::size_t>(solids.cell(i));
    if (solids.cell(i) >= 0 && volume[centre] > 0)
      force.damping = std::max(force.damping, slip_damping(owned[i], centre, volume[centre]));
    for (std::size_t k = 0; k < 3; ++k) total[k] += force.force[k];
  }
  MPI_Allreduce(MPI_IN_PLACE, total.data(), 3, MPI_DOUBLE, MPI_SUM, communicator_);
  double scale = 0;
  for (std::size_t cell = 0; cell < mesh_.cells(); ++cell) {
    if (volume[cell] <= 0) continue;
    for (std::size_t k = 0; k < 3; ++k) total[k] += mesh_.cell_volume[cell] * gradient_[3 * cell + k];
    scale += mesh_.cell_volume[cell] * norm(&gradient_[3 * cell]);
  }
  if (scale > 0) momentum_residual_ = std::max(momentum_residual_, norm(total.data()) / scale);
  return forces;
}

std::vector<double> GasCoupling::velocity() const {
  std::vector<double> velocity(mass_flux_.size());
  for (std::size_t cell = 0; cell < mesh_.cells(); ++cell) {
    for (std::size_t k = 0; k < 3; ++k)
      velocity[3 * cell + k] = mass_flux_[3 * cell + k] / density(cell) / void_solved_[cell];
  }
  return velocity;
}

nlohmann::json GasCoupling::summary() const {
  return {{"flow_solves", solves_},
          {"cells_at_void_floor", cells_at_floor_},
          {"inertia_over_drag_largest", flow_.inertia_over_drag_largest()},
          {"inlets", inlets_json(flow_.inlets())}};
}

void GasCoupling::save(HdfWriter& file) const {
  if (void_solved_.empty()) return;
  file.write("Gas/void_solved", void_solved_);
  file.write("Gas/pressure", pressure_);
  file.write("Gas/gradient", gradient_);
  file.write("Gas/speed", speed_);
  file.write("Gas/mass_flux", mass_flux_);
  file.write("Gas/squared_pressure", flow_.warm_start().squared_pressure);
  file.write("Gas/face_mass_flux", flow_.warm_start().face_mass_flux);
  file.write("Gas/face_pressure", flow_.face_pressure());
  file.write("Gas/inertia_over_drag", flow_.inertia_over_drag());
  file.write("Gas/counters", std::vector<std::int64_t>{solves_, cells_at_floor_});
  file.write("Gas/numbers", std::vector<double>{momentum_residual_, seconds_since_});
}

void GasCoupling::load(const HdfReader& file) {
  if (!file.has("Gas/void_solved")) return;
  void_solved_ = file.doubles("Gas/void_solved");
  pressure_ = file.doubles("Gas/pressure");
  gradient_ = file.doubles("Gas/gradient");
  speed_ = file.doubles("Gas/speed");
  mass_flux_ = file.doubles("Gas/mass_flux");
  flow_.restore({file.doubles("Gas/squared_pressure"), file.doubles("Gas/face_mass_flux")},
                file.doubles("Gas/face_pressure"), file.doubles("Gas/inertia_over_drag"));
  const auto counters = file.integers("Gas/counters", 2);
  solves_ = counters[0];
  cells_at_floor_ = counters[1];
  const auto numbers = file.doubles("Gas/numbers", 2);
  momentum_residual_ = numbers[0];
  seconds_since_ = numbers[1];
}

}  // namespace cupola
