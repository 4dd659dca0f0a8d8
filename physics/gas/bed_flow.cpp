#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "physics/gas/flow_state.hpp"
#include "schemas/failure.hpp"

namespace cupola {
namespace {

/// What the linear equation of the last iteration may leave of the mass balance (of the blast, summed over all cells),
/// by the tolerance asked for: loose solutions only to a thousandth of it, tight ones to round-off, so that they do not
/// depend on the number of ranks.  What is left over is closed along a tree.
double last_mass_tolerance(double tolerance) { return tolerance * std::min(1e-3, 10 * tolerance); }
/// Iterations before the last one: to this share of the last change, for what is not yet right need not be exact.
constexpr double loose_mass_tolerance = 1e-2;
constexpr double least_mass_tolerance = 3e-11;
/// Navier-Stokes starts from a Darcy-Forchheimer field that changes by less than this.
constexpr double start_tolerance = 1e-3;
constexpr int start_iterations = 100;
/// Inertia is damped where the iteration swings; below this it has failed.
constexpr double least_relaxation = 0.05;

}  // namespace

BedFlow::BedFlow(FoamCase& foam, const BedMesh& mesh, const Campaign& campaign, Model model)
    : state_(std::make_unique<State>(foam, mesh, campaign, model)) {}
BedFlow::~BedFlow() = default;

BedFlow::Result BedFlow::solve(const BedState& bed, const std::vector<double>& gas_temperature, double tolerance,
                               int most_iterations) {
  State& state = *state_;
  state.void_fraction = bed.void_fraction;
  state.temperature = gas_temperature;
  if (state.model == Model::darcy_forchheimer) return iterate(bed, gas_temperature, tolerance, most_iterations);
  Result begun;
  if (state.cold) {
    state.inertia_on = false;
    begun = iterate(bed, gas_temperature, start_tolerance, start_iterations);
  }
  state.inertia_on = true;
  try {
    Result result = iterate(bed, gas_temperature, tolerance, most_iterations);
    result.iterations += begun.iterations;
    result.cycles += begun.cycles;
    // A short warm iteration need not arrive; a long one must.
    if (result.change > std::max(100 * tolerance, 1e-3) && most_iterations > 10) {
      throw Failure(ExitCode::diverged, fmt::format("the Navier-Stokes iteration still changes the gas flow by {:.2g} "
                                                    "after {} iterations",
                                                    result.change, result.iterations));
    }
    if (state.too_fast > 0) {
      throw Failure(ExitCode::diverged,
                    fmt::format("in {} cells the gas would be faster than its heat allows", state.too_fast));
    }
    return result;
  } catch (Failure& failure) {
    if (failure.code() == ExitCode::diverged) failure.advise("tracer.gas", "darcy-forchheimer");
    throw;
  }
}

BedFlow::Result BedFlow::iterate(const BedState& bed, const std::vector<double>& gas_temperature, double tolerance,
                                 int most_iterations) {
  State& state = *state_;
  Result result;
  // What the first iteration is expected to change: all from nothing, little from a warm start.
  result.change = state.cold ? 1 : 1e-3;
  // The velocities begin with the warm start's alone, so that a resumed run is the undisturbed one.
  state.relaxation = 1;
  state.carried_velocity.clear();
  state.momentum = {std::vector<double>(state.mesh.cells(), 0),
                    std::vector<Vector3>(state.mesh.cells(), Vector3{0, 0, 0})};
  state.count_blast();
  double before = 1;
  for (bool last = false; !last;) {
    // The last iteration is the one that may be it.
    const bool strict = result.iterations + 1 >= most_iterations || result.change < 3 * tolerance;
    state.set_static_temperature(gas_temperature);
    state.set_resistances(bed);
    if (state.inertia_on) state.set_momentum();
    state.follow_openings();
    before = result.change;
    const double mass_tolerance = strict ? last_mass_tolerance(tolerance) : loose_mass_tolerance * result.change;
    result.change = state.step(result, std::max(least_mass_tolerance, mass_tolerance));
    ++result.iterations;
    state.count_blast();
    if (state.inertia_on && result.iterations > 3 && result.change > 0.95 * before)
      state.relaxation = std::max(least_relaxation, 0.8 * state.relaxation);
    last = strict && (result.change <= tolerance || result.iterations >= most_iterations);
  }
  state.close_mass();
  state.finish(bed, gas_temperature);
  double residual = 0;
  for (const double value : FaceGeometry::outflow(state.mesh, state.start.face_mass_flux)) residual += std::abs(value);
  result.mass_residual = residual / state.blast;
  return result;
}

const std::vector<double>& BedFlow::pressure() const { return state_->pressure; }
const std::vector<Vector3>& BedFlow::mass_flux() const { return state_->mass_flux; }
const std::vector<Vector3>& BedFlow::pressure_gradient() const {
  state_->derive();
  return state_->gradient;
}
const std::vector<double>& BedFlow::face_mass_flux() const { return state_->start.face_mass_flux; }
double BedFlow::inertia_over_drag_largest() const {
  state_->derive();
  return state_->inertia_largest;
}
const std::vector<double>& BedFlow::inertia_over_drag() const {
  state_->derive();
  return state_->inertia;
}
const BedFlow::WarmStart& BedFlow::warm_start() const { return state_->start; }
BedFlow::Model BedFlow::model() const { return state_->model; }

const std::vector<double>& BedFlow::face_pressure() const {
  state_->derive();
  return state_->face_pressure;
}

void BedFlow::restore(WarmStart start, std::vector<double> face_pressure, std::vector<double> inertia) {
  State& state = *state_;
  state.start = std::move(start);
  state.mass_flux = state.geometry.cell_vectors(state.mesh, state.start.face_mass_flux);
  state.set_pressure();
  state.face_pressure = std::move(face_pressure);
  state.gradient = FaceGeometry::surface_gradient(state.mesh, state.face_pressure);
  state.inertia = std::move(inertia);
  state.inertia_largest = state.inertia.empty() ? 0 : *std::max_element(state.inertia.begin(), state.inertia.end());
  state.cold = false;
  state.solved_for.reset();
}

std::vector<BedFlow::NamedInlet> BedFlow::inlets() const {
  state_->derive();
  const State& state = *state_;
  const auto flows = state.openings.mass_flow(state.start.face_mass_flux);
  const auto pressures = state.openings.mean(state.face_pressure);
  std::vector<NamedInlet> result;
  for (std::size_t i = 0; i < flows.size(); ++i) {
    result.push_back({state.openings.inlets()[i].name, state.openings.state(i, flows[i], pressures[i]), flows[i],
                      state.openings.smallest_opening(i, flows[i], pressures[i])});
  }
  return result;
}

}  // namespace cupola
