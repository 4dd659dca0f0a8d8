#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "tests/support/tracer_program.hpp"
#include "tests/verification/tracer/column.hpp"

/// Order of convergence in the time step of the whole stage.
namespace cupola {
namespace {

/// A bed of two layered species that sinks through a column against the blast: motion, charge, removal, composition,
/// flow (which follows the composition), exchange and conduction; all but melting, which is an event.
Campaign sinking_bed(double step) {
  Campaign campaign = testing::column_campaign(20);
  campaign.species[0].diameter = 20e-3;
  campaign.species[0].conductivity = 5;
  testing::add_fine_grains(campaign, 10e-3, 20);
  campaign.species[0].coarse_graining = 2;
  campaign.species[1].coarse_graining = 4;
  campaign.charging.layers = {{{"pebble", 6}}, {{"fine", 6}}};
  campaign.charging.rings.clear();
  campaign.raceways.resize(1);
  campaign.raceways[0].box = {Vector3{-0.1, -0.1, 0}, Vector3{0.1, 0.1, 0.2}};
  campaign.raceways[0].void_fraction = 0.3;
  campaign.raceways[0].dem_removal_rate = 10;
  campaign.descent_rate = 1e-3;
  campaign.scene.heat_loss = WallHeatLoss{20, 293};
  campaign.tracer.tracers_per_cell = 200;
  campaign.tracer.duration = 200;
  campaign.tracer.time_step = step;
  campaign.tracer.resolve = TracerSettings::Resolve::every_step;
  return campaign;
}

/// Temperatures at the end: of the tracers that were there at the beginning (those charged on the way are numbered in
/// another order where steps are others), and the mean of all.
struct End {
  std::vector<std::int64_t> id;
  std::vector<double> temperature;
  double mean = 0;
};

End end_of(testing::TracerProgram& program, double step) {
  program.march_anew(sinking_bed(step));
  EXPECT_EQ(program.run(), 0) << program.failure();
  const testing::FinalTracers tracers = program.tracers();
  const auto parcels = FieldFile(program.path() / "granular.hdf", "dem-result").hdf().integers("Packing/id");
  const std::int64_t first_charged = (parcels.back() + 1) * 1000;
  End end;
  double volume = 0;
  for (std::size_t i = 0; i < tracers.id.size(); ++i) {
    if (tracers.id[i] < first_charged) {
      end.id.push_back(tracers.id[i]);
      end.temperature.push_back(tracers.temperature[i]);
    }
    end.mean += tracers.volume[i] * tracers.temperature[i];
    volume += tracers.volume[i];
  }
  end.mean /= volume;
  return end;
}

/// Relative rms of the differences of two sets of temperatures, above 293 K.
double difference(const std::vector<double>& found, const std::vector<double>& reference) {
  double square = 0;
  double scale = 0;
  for (std::size_t i = 0; i < found.size(); ++i) {
    square += std::pow(found[i] - reference[i], 2);
    scale += std::pow(reference[i] - 293, 2);
  }
  return std::sqrt(square / scale);
}

/// Mean order over a refinement by halves; prints what it is made of.
double order_of(const char* what, const std::vector<double>& steps, const std::vector<double>& errors) {
  for (std::size_t k = 0; k < steps.size(); ++k)
    std::printf("%s, step %.4g s: error %.3g\n", what, steps[k], errors[k]);
  const double order = std::log2(errors.front() / errors.back()) / static_cast<double>(steps.size() - 1);
  std::printf("%s: order %.2f\n", what, order);
  return order;
}

/// Without motion, every part that depends on the step is left but the paths: gas, exchange, conduction between and in
/// the species.
TEST(TimeOrder, BedAtRest) {
  const auto at_rest = [](double step) {
    Campaign campaign = testing::column_campaign(40);
    campaign.species[0].diameter = 20e-3;
    campaign.tracer.duration = 160;
    campaign.tracer.time_step = step;
    return campaign;
  };
  testing::TracerProgram program(at_rest(1), [](const BedMesh& mesh, const Campaign& campaign) {
    return testing::bed_at_rest(mesh, campaign, 0.6);
  });
  const auto end = [&](double step) {
    program.march_anew(at_rest(step));
    EXPECT_EQ(program.run(), 0) << program.failure();
    return program.tracers().temperature;
  };
  const auto reference = end(1);
  const std::vector<double> steps{40, 20, 10};
  std::vector<double> errors;
  for (const double step : steps) errors.push_back(difference(end(step), reference));
  EXPECT_GT(order_of("bed at rest", steps, errors), 1.8);
}

/// Tracers that cross several cells feel the gas of each for as long as they are in it: first order at least, of each
/// single tracer.
TEST(TimeOrder, SinkingBed) {
  testing::TracerProgram program(sinking_bed(20));
  const End reference = end_of(program, 0.3125);
  const std::vector<double> steps{20, 10, 5};
  std::vector<double> tracers, mean;
  for (const double step : steps) {
    const End end = end_of(program, step);
    ASSERT_EQ(end.id, reference.id);  // lives and paths do not depend on the step
    tracers.push_back(difference(end.temperature, reference.temperature));
    mean.push_back(std::abs(end.mean - reference.mean) / (reference.mean - 293));
  }
  EXPECT_GT(order_of("sinking bed, tracers", steps, tracers), 1);
  order_of("sinking bed, mean of all", steps, mean);
  EXPECT_LT(mean.back(), 1e-4);
}

}  // namespace
}  // namespace cupola
