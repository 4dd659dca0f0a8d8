#include "stage_dem/transient_coupling.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

#include "physics/closures/gas_properties.hpp"
#include "physics/closures/sutherland.hpp"
#include "physics/gas/cell_vectors.hpp"
#include "physics/gas/inlets_json.hpp"
#include "stage_dem/parcels.hpp"

namespace cupola {
namespace {

/// Parcels that only moved keep their volume to round-off.
constexpr double same_volume = 1e-9;
/// A step may be longer than the one before by this factor: the flow of the first ones is not known yet.
constexpr double growth = 1.5;
constexpr double of_stopping_time = 0.1;
/// The first step over a block: the flow it finds says how long the next may be.
constexpr double first_step = 1e-3;

}  // namespace

TransientCoupling::TransientCoupling(FoamCase& foam, const BedMesh& mesh, const Campaign& campaign,
                                     std::vector<double> gas_temperature, MPI_Comm communicator)
    : mesh_(mesh),
      campaign_(campaign),
      communicator_(communicator),
      flow_(foam, mesh, campaign, gas_temperature),
      turbulence_(make_turbulence(foam, mesh, campaign)),
      temperature_(std::move(gas_temperature)) {}

void TransientCoupling::update(const SolidsOnMesh& solids, const std::vector<Parcel>& owned, double seconds,
                               bool /*in_any_case*/) {
  if (seconds <= 0) return;
  const BedState bed = bed_state(mesh_, campaign_, solids.species_volume());
  cells_at_floor_ = bed.cells_at_floor;
  const double volume = std::accumulate(solids.volume().begin(), solids.volume().end(), 0.0);
  if (std::abs(volume - solids_volume_) > same_volume * volume) flow_.take_void_fraction(bed.void_fraction);
  solids_volume_ = volume;
  const auto momentum = solids.sums(3, [&](std::size_t i, std::span<double> value) {
    for (std::size_t k = 0; k < 3; ++k) value[k] = material_volume(campaign_, owned[i]) * owned[i].velocity[k];
    return true;
  });
  std::vector<Vector3> velocity(mesh_.cells(), Vector3{});
  for (std::size_t cell = 0; cell < mesh_.cells(); ++cell) {
    if (!(solids.volume()[cell] > 0)) continue;
    for (std::size_t k = 0; k < 3; ++k) velocity[cell][k] = momentum[3 * cell + k] / solids.volume()[cell];
  }
  flow_.step({bed, solids.volume(), velocity}, temperature_, seconds);
  if (turbulence_) {
    turbulence_->step(flow_, temperature_, seconds);
    flow_.set_eddy_viscosity(turbulence_->eddy_viscosity());
  }
  last_step_ = seconds;
  ++steps_;
  mass_residual_ = std::max(mass_residual_, flow_.mass_residual());
  // Drag on the solids of a cell: e^2 r by volume of cell and slip.
  double least_density = std::numeric_limits<double>::infinity();
  for (const auto& species : campaign_.species) least_density = std::min(least_density, species.density);
  double stiffest = 0;
  for (std::size_t cell = 0; cell < mesh_.cells(); ++cell) {
    if (!(solids.volume()[cell] > 0)) continue;
    const double e = bed.void_fraction[cell];
    stiffest = std::max(
        stiffest, e * e * flow_.resistance()[cell] * mesh_.cell_volume[cell] / solids.volume()[cell] / least_density);
  }
  stopping_time_ = stiffest > 0 ? 1 / stiffest : 0;
}

double TransientCoupling::longest_step() const {
  double longest = std::min(campaign_.dem.transient.time_step.value_or(campaign_.dem.block),
                            campaign_.dem.transient.courant * flow_.crossing_time());
  if (stopping_time_ > 0) longest = std::min(longest, of_stopping_time * stopping_time_);
  return std::min(longest, last_step_ > 0 ? growth * last_step_ : first_step * campaign_.dem.block);
}

std::vector<ParcelForce> TransientCoupling::forces(const SolidsOnMesh& solids, const std::vector<Parcel>& owned) {
  const auto& volume = solids.volume();
  // On a unit of material volume in each cell.
  std::array<std::vector<double>, 3> drag;
  std::array<std::vector<double>, 3> buoyancy;
  drag.fill(std::vector<double>(mesh_.cells(), 0.0));
  buoyancy.fill(std::vector<double>(mesh_.cells(), 0.0));
  double scale = 0;
  for (std::size_t cell = 0; cell < mesh_.cells(); ++cell) {
    if (!(volume[cell] > 0)) continue;
    scale += mesh_.cell_volume[cell] * magnitude(flow_.drag()[cell]);
    for (std::size_t k = 0; k < 3; ++k) {
      drag[k][cell] = mesh_.cell_volume[cell] / volume[cell] * flow_.drag()[cell][k];
      buoyancy[k][cell] = -flow_.pressure_gradient()[cell][k];
    }
  }
  for (std::size_t k = 0; k < 3; ++k) {
    solids.gather(drag[k]);
    solids.gather(buoyancy[k]);
  }
  std::vector<ParcelForce> forces(owned.size());
  std::array<double, 3> total{};
  for (std::size_t i = 0; i < owned.size(); ++i) {
    const double parcel_volume = material_volume(campaign_, owned[i]);
    for (const auto& [index, share] : solids.shares(i)) {
      const auto cell = static_cast<std::size_t>(index);
      for (std::size_t k = 0; k < 3; ++k) {
        const double part = parcel_volume * share * drag[k][cell];
        forces[i].force[k] += part + parcel_volume * share * buoyancy[k][cell];
        total[k] += part;
      }
    }
  }
  MPI_Allreduce(MPI_IN_PLACE, total.data(), 3, MPI_DOUBLE, MPI_SUM, communicator_);
  Vector3 left = flow_.force_of_solids();
  for (std::size_t k = 0; k < 3; ++k) left[k] += total[k];
  if (scale > 0) momentum_residual_ = std::max(momentum_residual_, magnitude(left) / scale);
  return forces;
}

std::vector<double> TransientCoupling::velocity() const {
  std::vector<double> velocity(3 * mesh_.cells());
  for (std::size_t cell = 0; cell < mesh_.cells(); ++cell)
    for (std::size_t k = 0; k < 3; ++k) velocity[3 * cell + k] = flow_.velocity()[cell][k];
  return velocity;
}

nlohmann::json TransientCoupling::summary() const {
  nlohmann::json summary{{"flow_solves", steps_},
                         {"cells_at_void_floor", cells_at_floor_},
                         {"mass_residual", mass_residual_},
                         {"last_step", last_step_},
                         {"inlets", inlets_json(flow_.inlets())}};
  if (turbulence_) {
    double largest = 0;
    for (std::size_t cell = 0; cell < mesh_.cells(); ++cell)
      largest = std::max(largest,
                         turbulence_->eddy_viscosity()[cell] / gas_viscosity(*campaign_.scene.gas, temperature_[cell]));
    summary["turbulence"] = {{"eddy_viscosity_over_viscosity_largest", largest},
                             {"cells_of_limited_shear", flow_.cells_of_limited_shear()},
                             {"k_largest", *std::max_element(turbulence_->k().begin(), turbulence_->k().end())}};
  }
  return summary;
}

void TransientCoupling::save(HdfWriter& file) const {
  if (steps_ == 0) return;
  const auto memory = flow_.memory();
  file.write("Gas/pressure", memory.pressure);
  file.write("Gas/face_mass_flux", memory.face_mass_flux);
  file.write("Gas/void_fraction", memory.void_fraction);
  file.write("Gas/density", memory.gas_density);
  file.write("Gas/face_pressure", memory.face_pressure);
  if (turbulence_) {
    file.write("Gas/k", turbulence_->k());
    file.write("Gas/epsilon", turbulence_->epsilon());
    file.write("Gas/eddy_viscosity", turbulence_->eddy_viscosity());
  }
  file.write("Gas/counters", std::vector<std::int64_t>{steps_, cells_at_floor_});
  file.write("Gas/numbers",
             std::vector<double>{momentum_residual_, mass_residual_, solids_volume_, last_step_, stopping_time_});
}

void TransientCoupling::load(const HdfReader& file) {
  if (!file.has("Gas/pressure")) return;
  flow_.restore({file.doubles("Gas/pressure"), file.doubles("Gas/face_mass_flux"), file.doubles("Gas/void_fraction"),
                 file.doubles("Gas/density"), file.doubles("Gas/face_pressure")});
  if (turbulence_) {
    turbulence_->restore(flow_, temperature_, file.doubles("Gas/k"), file.doubles("Gas/epsilon"),
                         file.doubles("Gas/eddy_viscosity"));
    flow_.set_eddy_viscosity(turbulence_->eddy_viscosity());
  }
  const auto counters = file.integers("Gas/counters", 2);
  steps_ = counters[0];
  cells_at_floor_ = counters[1];
  const auto numbers = file.doubles("Gas/numbers", 5);
  momentum_residual_ = numbers[0];
  mass_residual_ = numbers[1];
  solids_volume_ = numbers[2];
  last_step_ = numbers[3];
  stopping_time_ = numbers[4];
}

}  // namespace cupola
