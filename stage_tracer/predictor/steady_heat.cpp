#include "stage_tracer/predictor/steady_heat.hpp"

#include <algorithm>
#include <cmath>

#include "stage_tracer/bed_composition.hpp"
#include "stage_tracer/predictor/anderson.hpp"

namespace cupola {
namespace {

/// Cells of which lines fill less than this share count as not reached, the more so the less they fill.
constexpr double least_covered = 0.1;
constexpr std::size_t anderson_depth = 10;
/// The upwind equations are a guide only: more accuracy would not be used.
constexpr double linear_reduction = 0.03;
constexpr int linear_iterations = 120;

std::vector<double> flat(const BedTemperatures& t) {
  const std::size_t fields = 1 + t.solids.size();
  std::vector<double> x(t.gas.size() * fields);
  for (std::size_t c = 0; c < t.gas.size(); ++c) {
    x[c * fields] = t.gas[c];
    for (std::size_t s = 0; s + 1 < fields; ++s) x[c * fields + s + 1] = t.solids[s][c];
  }
  return x;
}

double rms(const std::vector<double>& values, const std::vector<double>& weights) {
  double sum = 0;
  double weight = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    sum += weights[i] * values[i] * values[i];
    weight += weights[i];
  }
  return weight > 0 ? std::sqrt(sum / weight) : 0;
}

void unfold(const std::vector<double>& x, BedTemperatures& t) {
  const std::size_t fields = 1 + t.solids.size();
  for (std::size_t c = 0; c < t.gas.size(); ++c) {
    t.gas[c] = x[c * fields];
    for (std::size_t s = 0; s + 1 < fields; ++s) t.solids[s][c] = x[c * fields + s + 1];
  }
}

}  // namespace

std::array<double, 2> temperature_range(const Campaign& campaign) {
  double coldest = campaign.charging.temperature;
  double hottest = coldest;
  if (campaign.scene.heat_loss) coldest = std::min(coldest, campaign.scene.heat_loss->ambient);
  for (const Inlet& inlet : campaign.scene.gas->inlets) {
    coldest = std::min(coldest, inlet.total_temperature);
    hottest = std::max(hottest, inlet.total_temperature);
  }
  return {coldest, hottest};
}

/// The equations of one call of `solve`.
class SteadyHeat::Evaluation {
 public:
  Evaluation(const SteadyHeat& own, const Bed& bed, GasModel& gas, CellContents contents)
      : mesh_(own.mesh_),
        campaign_(own.campaign_),
        kernel_(own.kernel_),
        conduction_(own.conduction_),
        sum_(own.sum_),
        bed_(bed),
        gas_(gas),
        exchange_(campaign_, kernel_),
        sweep_(mesh_, campaign_, bed.field.charge.volume_share),
        filling_(share_of_persistent(campaign_, bed.field.charge)),
        contents_(std::move(contents)) {
    exchange_.set_rates({gas.flow().mass_flux(), gas.temperature(), bed.state.void_fraction}, contents_);
    rate_ = exchange_.felt_coefficient();
    for (std::size_t s = 0; s < rate_.size(); ++s) {
      for (double& rate : rate_[s]) rate *= 6 / (campaign_.species[s].diameter * sweep_.capacity()[s]);
    }
    const auto range = temperature_range(campaign_);
    coldest = range[0];
    hottest = range[1];
  }

  double coldest;  ///< K
  double hottest;

  /// @return what the temperatures would be in those of `from`
  BedTemperatures evaluate(const BedTemperatures& from) {
    SolidsSurroundings around{rate_, exchange_.felt_temperature(from.gas), conducted(from.solids)};
    for (std::size_t s = 0; bed_.tendency != nullptr && s < around.source.size(); ++s) {
      for (std::size_t c = 0; c < around.source[s].size(); ++c) around.source[s][c] -= (*bed_.tendency)[s][c];
    }
    keep_in_range(around);
    solids_ = sweep_(bed_.lines, bed_.packing, bed_.sink, around, sum_);
    rest_where_nothing_passes(around);
    contents_ = solids_.contents;
    gas_.solve_energy(bed_.state, exchange_.solids(contents_, 0));
    BedTemperatures result{gas_.temperature(), contents_.temperature};
    for (std::size_t s = 0; s < result.solids.size(); ++s) {
      for (std::size_t c = 0; c < result.gas.size(); ++c) {
        if (contents_.volume[s][c] > 0) continue;
        // Where a species is not, its temperature means nothing; this one joins smoothly to where it melts away.
        const auto& softening = campaign_.species[s].softening;
        result.solids[s][c] = softening ? std::min(around.felt[s][c], softening->melted) : around.felt[s][c];
      }
    }
    return result;
  }

  /// The upwind equations of all temperatures, to be read with `right_side`.
  CounterFlowMatrix linearise() {
    const std::size_t species = contents_.volume.size();
    CounterFlowMatrix matrix(mesh_, 1 + species);
    add_gas(matrix);
    for (std::size_t s = 0; s < species; ++s) {
      for (std::size_t c = 0; c < mesh_.cells(); ++c) add_solids(matrix, s, c);
    }
    const std::size_t cells = mesh_.cells();
    for (const Link& link : conduction_.links(spread(contents_, kernel_), bed_.volume)) {
      const std::size_t s = link.first / cells;
      const std::size_t t = link.second / cells;
      const std::size_t a = link.first % cells;
      const std::size_t b = link.second % cells;
      if (!(contents_.volume[s][a] > 0) || !(contents_.volume[t][b] > 0)) continue;
      matrix.diagonal(a, 1 + s, 1 + s) += link.conductance;
      matrix.diagonal(b, 1 + t, 1 + t) += link.conductance;
      if (a == b) {
        matrix.diagonal(a, 1 + s, 1 + t) -= link.conductance;
        matrix.diagonal(a, 1 + t, 1 + s) -= link.conductance;
        continue;
      }
      for (std::size_t side = 0; side < 6; ++side) {
        if (mesh_.across(static_cast<std::int64_t>(a), mesh_.cell_faces[a][side]) != static_cast<std::int64_t>(b))
          continue;
        matrix.beside(a, side, 1 + s) += link.conductance;
        matrix.beside(b, side ^ 1U, 1 + s) += link.conductance;
        break;
      }
    }
    matrix.factorise();
    return matrix;
  }

  /// What the differences of an evaluation mean for the upwind equations, W: gas A_g r_g - K r_s, solids (U + K) r_s.
  [[nodiscard]] std::vector<double> right_side(const std::vector<double>& difference) const {
    const std::size_t fields = 1 + contents_.volume.size();
    std::vector<double> result(difference.size());
    for (std::size_t c = 0; c < mesh_.cells(); ++c) {
      for (std::size_t i = 0; i < fields; ++i) {
        double value = carried_[c * fields + i] * difference[c * fields + i];
        for (std::size_t side = 0; side < 6; ++side) {
          const auto other = mesh_.across(static_cast<std::int64_t>(c), mesh_.cell_faces[c][side]);
          if (other >= 0) value -= brought_[(c * 6 + side) * fields + i] * difference[other * fields + i];
        }
        if (i > 0) {
          value += conductance_[c * fields + i] * difference[c * fields + i];
          result[c * fields] -= conductance_[c * fields + i] * difference[c * fields + i];
        }
        result[c * fields + i] += value;
      }
    }
    return result;
  }

  [[nodiscard]] const SolidsOnLines& solids() const { return solids_; }

  /// Weights of the unknowns: the gas of a cell counts with the cell's volume, a species with its share of the solids.
  [[nodiscard]] std::vector<double> weights() const {
    const std::size_t fields = 1 + contents_.volume.size();
    std::vector<double> result(mesh_.cells() * fields, 0.0);
    for (std::size_t c = 0; c < mesh_.cells(); ++c) {
      if (!bed_.field.bed[c]) continue;
      double solids = 0;
      for (const auto& volume : contents_.volume) solids += volume[c];
      result[c * fields] = mesh_.cell_volume[c];
      for (std::size_t i = 1; i < fields && solids > 0; ++i)
        result[c * fields + i] = mesh_.cell_volume[c] * contents_.volume[i - 1][c] / solids;
    }
    return result;
  }

 private:
  /// K/s that conduction adds to each species.
  BySpecies conducted(const BySpecies& temperature) const {
    const std::size_t cells = mesh_.cells();
    CellContents held{contents_.volume, temperature};
    const CellContents around = spread(held, kernel_);
    std::vector<double> flat_temperature(temperature.size() * cells);
    for (std::size_t i = 0; i < flat_temperature.size(); ++i)
      flat_temperature[i] = around.temperature[i / cells][i % cells];
    const std::vector<double> inflow = network_inflow(conduction_.links(around, bed_.volume), flat_temperature);
    BySpecies source(temperature.size(), std::vector<double>(cells, 0.0));
    for (std::size_t s = 0; s < source.size(); ++s) {
      const double heat = sweep_.capacity()[s];
      for (std::size_t c = 0; c < cells; ++c) {
        if (around.volume[s][c] > 0) source[s][c] = inflow[s * cells + c] / (heat * around.volume[s][c]);
      }
      kernel_.gather(source[s]);
    }
    return source;
  }

  /// Far from the solution conduction may ask for temperatures beyond all that comes in; the solution never does.
  void keep_in_range(SolidsSurroundings& around) const {
    for (std::size_t s = 0; s < around.source.size(); ++s) {
      for (std::size_t c = 0; c < around.source[s].size(); ++c) {
        const double rate = around.rate[s][c];
        const double felt = around.felt[s][c];
        around.source[s][c] =
            std::clamp(around.source[s][c], rate * std::min(0.0, coldest - felt), rate * std::max(0.0, hottest - felt));
      }
    }
  }

  /// Cells that no streamline reaches hold the persistent species at rest, in balance with gas and neighbours.
  void rest_where_nothing_passes(const SolidsSurroundings& around) {
    CellContents& contents = solids_.contents;
    for (std::size_t c = 0; c < mesh_.cells(); ++c) {
      if (!bed_.field.bed[c]) continue;
      // The less a cell is reached the more of it rests, so that nothing jumps when a line comes or goes.
      const double missing = 1 - solids_.passed[c] / (least_covered * mesh_.cell_volume[c]);
      if (missing <= 0) continue;
      for (std::size_t s = 0; s < filling_.size(); ++s) {
        if (!(filling_[s] > 0)) continue;
        const double volume = missing * filling_[s] * bed_.field.solids_fraction[c] * mesh_.cell_volume[c];
        const double balance = around.felt[s][c] + around.source[s][c] / around.rate[s][c];
        double& mean = contents.temperature[s][c];
        mean = (mean * contents.volume[s][c] + balance * volume) / (contents.volume[s][c] + volume);
        contents.volume[s][c] += volume;
      }
    }
  }

  void add_gas(CounterFlowMatrix& matrix) {
    const std::size_t fields = 1 + contents_.volume.size();
    const double heat = campaign_.scene.gas->heat_capacity;
    const std::vector<double>& flux = gas_.flow().face_mass_flux();
    carried_.assign(mesh_.cells() * fields, 0.0);
    brought_.assign(mesh_.cells() * 6 * fields, 0.0);
    conductance_.assign(mesh_.cells() * fields, 0.0);
    for (std::size_t c = 0; c < mesh_.cells(); ++c) {
      for (std::size_t side = 0; side < 6; ++side) {
        const std::int64_t face = mesh_.cell_faces[c][side];
        const double inward = mesh_.face_owner[face] == static_cast<std::int64_t>(c) ? -flux[face] : flux[face];
        const auto other = mesh_.across(static_cast<std::int64_t>(c), face);
        const double brings = heat * std::max(0.0, inward);
        carried_[c * fields] += other == static_cast<std::int64_t>(c) ? 0 : brings;
        if (other < 0 && campaign_.scene.heat_loss && wall(face)) carried_[c * fields] += wall_conductance(face);
        if (other >= 0 && other != static_cast<std::int64_t>(c)) {
          matrix.beside(c, side, 0) += brings;
          brought_[(c * 6 + side) * fields] = brings;
        }
      }
      // Gas at rest is held by its own conduction, which counts for nothing elsewhere.
      carried_[c * fields] = std::max(carried_[c * fields], 1e-9 * heat);
      matrix.diagonal(c, 0, 0) += carried_[c * fields];
    }
  }

  void add_solids(CounterFlowMatrix& matrix, std::size_t s, std::size_t c) {
    const std::size_t fields = 1 + contents_.volume.size();
    const std::size_t i = c * fields + 1 + s;
    const double volume = contents_.volume[s][c];
    if (!(volume > 0)) {
      carried_[i] = 1;
      matrix.diagonal(c, 1 + s, 1 + s) = 1;
      return;
    }
    for (std::size_t side = 0; side < 7; ++side) {
      const double brings = solids_.inflow[s][7 * c + side];
      carried_[i] += brings;
      if (side == 6) continue;
      matrix.beside(c, side, 1 + s) += brings;
      brought_[(c * 6 + side) * fields + 1 + s] = brings;
    }
    const double exchange = exchange_.coefficient()[s][c] * 6 * volume / campaign_.species[s].diameter;
    conductance_[i] = exchange;
    matrix.diagonal(c, 1 + s, 1 + s) += carried_[i] + exchange;
    matrix.diagonal(c, 0, 0) += exchange;
    matrix.diagonal(c, 0, 1 + s) -= exchange;
    matrix.diagonal(c, 1 + s, 0) -= exchange;
  }

  [[nodiscard]] bool wall(std::int64_t face) const {
    const auto* patch = mesh_.patch_of(face);
    return patch != nullptr && patch->kind == BedMesh::PatchKind::wall;
  }
  [[nodiscard]] double wall_conductance(std::int64_t face) const {
    const Vector3& a = mesh_.face_area[face];
    return campaign_.scene.heat_loss->coefficient * std::hypot(a[0], a[1], a[2]);
  }

  const BedMesh& mesh_;
  const Campaign& campaign_;
  const CellSpreading& kernel_;
  const Conduction& conduction_;
  const SumOverRanks& sum_;
  const Bed& bed_;
  GasModel& gas_;
  Exchange exchange_;
  SolidsSweep sweep_;
  BySpecies rate_;  ///< 1/s
  std::vector<double> filling_;
  CellContents contents_;
  SolidsOnLines solids_;
  std::vector<double> carried_;      ///< W/K that flows carry through a cell (and its wall takes), [cell][field]
  std::vector<double> brought_;      ///< W/K from each neighbour, [cell][side][field]
  std::vector<double> conductance_;  ///< W/K between gas and solids, [cell][field], 0 for the gas itself
};

SteadyHeat::Result SteadyHeat::solve(const Bed& bed, GasModel& gas, CellContents contents,
                                     BedTemperatures& temperatures, double tolerance, int most_evaluations) {
  Evaluation equations(*this, bed, gas, std::move(contents));
  std::optional<Anderson> acceleration;
  std::optional<CounterFlowMatrix> matrix;
  Result result;
  std::vector<double> x = flat(temperatures);
  while (result.evaluations < most_evaluations) {
    unfold(x, temperatures);
    const std::vector<double> there = flat(equations.evaluate(temperatures));
    ++result.evaluations;
    if (!matrix) {
      matrix = equations.linearise();
      acceleration.emplace(anderson_depth, equations.weights());
    }
    std::vector<double> difference(x.size());
    for (std::size_t i = 0; i < x.size(); ++i) difference[i] = there[i] - x[i];
    std::vector<double> correction;
    const auto solution =
        matrix->solve(equations.right_side(difference), correction, linear_reduction, linear_iterations);
    result.linear_iterations += solution.iterations;
    result.correction = rms(correction, equations.weights());
    x = acceleration->next(x, correction);
    for (double& value : x) value = std::clamp(value, equations.coldest, equations.hottest);
    if (result.correction < tolerance) break;
  }
  unfold(x, temperatures);
  result.solids = equations.solids();
  return result;
}

}  // namespace cupola
