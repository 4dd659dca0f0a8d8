#include "stage_tracer/gas_model.hpp"

#include <algorithm>
#include <cmath>

#include "physics/closures/drag.hpp"
#include "physics/closures/sutherland.hpp"
#include "physics/plan/inlet_limit.hpp"
#include "schemas/failure.hpp"

namespace cupola {
namespace {

// The flow may lag behind the bed by forty times the accuracy: re-solved at a change of the resistance by 40 %, the
// temperatures of an hour shift by 0.06 % (NUMERICS_NOTES, table of re-solve rules).
constexpr double lag_over_accuracy = 40;
constexpr double tight_tolerance = 1e-6;
// Solved in every step to this; ranks then agree to 1e-11, for the iterations before the last one are loose on each
// decomposition in its own way, and what they leave shrinks with the last change.
constexpr double every_step_tolerance = 1e-8;
constexpr int tight_iterations = 60;
// A warm solution need not be better than the lag allowed: the next one starts from it. One iteration a step loses 0.02
// K.
constexpr int warm_iterations = 2;

std::unique_ptr<BedFlow> make_flow(FoamCase& foam, const BedMesh& mesh, const Campaign& campaign) {
  if (campaign.tracer.gas == TracerSettings::GasModel::navier_stokes)
    return std::make_unique<NavierStokes>(foam, mesh, campaign);
  return std::make_unique<DarcyForchheimer>(foam, mesh, campaign);
}

}  // namespace

GasModel::GasModel(FoamCase& foam, const BedMesh& mesh, const Campaign& campaign)
    : campaign_(campaign),
      flow_(make_flow(foam, mesh, campaign)),
      energy_(campaign.heat ? std::make_unique<GasEnergy>(foam, mesh, campaign) : nullptr),
      threshold_(std::clamp(lag_over_accuracy * campaign.tracer.accuracy, 0.02, 0.4)) {}

void GasModel::begin(const BedState& bed, std::vector<double> first_guess) {
  temperature_ = std::move(first_guess);
  if (energy_) energy_->restore(temperature_);
  solve_flow_tightly(bed);
}

void GasModel::solve_flow_tightly(const BedState& bed) {
  const bool every_step = campaign_.tracer.resolve == TracerSettings::Resolve::every_step;
  solve_flow(bed, every_step ? every_step_tolerance : tight_tolerance, tight_iterations);
  const Gas& gas = *campaign_.scene.gas;
  const auto blown = flow_->inlets();
  for (std::size_t i = 0; i < blown.size(); ++i) {
    Inlet inlet = gas.inlets[i];
    inlet.mass_flow = blown[i].mass_flow;
    const std::string refusal = inlet_refusal(gas, inlet, blown[i].state);
    if (!refusal.empty()) throw Failure(ExitCode::wrong_input, refusal).at("key", "scene.gas.inlets");
  }
}

void GasModel::follow(const BedState& bed) {
  if (campaign_.tracer.resolve == TracerSettings::Resolve::every_step) {
    solve_flow_tightly(bed);
    return;
  }
  const std::vector<double> now = resistance(bed);
  double difference = 0;
  double norm = 0;
  for (std::size_t c = 0; c < now.size(); ++c) {
    difference += (now[c] - last_resistance_[c]) * (now[c] - last_resistance_[c]);
    norm += last_resistance_[c] * last_resistance_[c];
  }
  if (difference <= threshold_ * threshold_ * norm) {
    ++flow_skips_;
    return;
  }
  solve_flow(bed, campaign_.tracer.accuracy, warm_iterations);
}

void GasModel::solve_energy(const BedState& bed, const SolidsExchange& solids) {
  temperature_ = energy_->solve(*flow_, bed, solids);
  ++energy_solves_;
}

std::vector<double> GasModel::resistance(const BedState& bed) const {
  const Gas& gas = *campaign_.scene.gas;
  const std::vector<Vector3>& flux = flow_->mass_flux();
  std::vector<double> result(temperature_.size());
  for (std::size_t c = 0; c < result.size(); ++c) {
    // The resistance depends on density x speed alone, so any density will do.
    const double speed = flux.empty() ? 0 : std::hypot(flux[c][0], flux[c][1], flux[c][2]);
    result[c] =
        bed.void_fraction[c] < 1
            ? temperature_[c] * drag_resistance(campaign_.drag, bed.void_fraction[c], bed.grain_diameter[c],
                                                gas_viscosity(gas, temperature_[c]), 1.0, speed, bed.drag_factor[c])
            : 0;
  }
  return result;
}

void GasModel::solve_flow(const BedState& bed, double tolerance, int most_iterations) {
  flow_->solve(bed, temperature_, tolerance, most_iterations);
  last_resistance_ = resistance(bed);
  ++flow_solves_;
}

GasModel::State GasModel::state() const {
  return {flow_->warm_start(), flow_->face_pressure(), flow_->inertia_over_drag(),
          temperature_,        last_resistance_,       flow_solves_,
          flow_skips_,         energy_solves_};
}

void GasModel::restore(State state) {
  flow_->restore(std::move(state.start), std::move(state.face_pressure), std::move(state.inertia_over_drag));
  temperature_ = std::move(state.temperature);
  if (energy_) energy_->restore(temperature_);
  last_resistance_ = std::move(state.last_resistance);
  flow_solves_ = state.flow_solves;
  flow_skips_ = state.flow_skips;
  energy_solves_ = state.energy_solves;
}

void GasModel::save(HdfWriter& file) const {
  const State now = state();
  file.write("Gas/squared_pressure", now.start.squared_pressure);
  file.write("Gas/face_mass_flux", now.start.face_mass_flux);
  file.write("Gas/face_pressure", now.face_pressure);
  file.write("Gas/inertia_over_drag", now.inertia_over_drag);
  file.write("Gas/temperature", now.temperature);
  file.write("Gas/last_resistance", now.last_resistance);
  file.write("Gas/counts", std::vector<std::int64_t>{now.flow_solves, now.flow_skips, now.energy_solves});
}

void GasModel::restore(const HdfReader& file) {
  const std::vector<std::int64_t> counts = file.integers("Gas/counts", 3);
  restore({{file.doubles("Gas/squared_pressure"), file.doubles("Gas/face_mass_flux")},
           file.doubles("Gas/face_pressure"),
           file.doubles("Gas/inertia_over_drag"),
           file.doubles("Gas/temperature"),
           file.doubles("Gas/last_resistance"),
           static_cast<long>(counts[0]),
           static_cast<long>(counts[1]),
           static_cast<long>(counts[2])});
}

}  // namespace cupola
