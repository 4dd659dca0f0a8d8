#include "stage_tracer/predictor/surrogate_flux.hpp"

#include <numeric>

namespace cupola {
namespace {

/// The divergence is right to this share of the total sink: paths notice nothing smaller.
constexpr double tolerance = 1e-9;
constexpr double acceptable = 1e-6;

}  // namespace

SurrogateFlux::SurrogateFlux(FoamCase& foam, const BedMesh& mesh, const std::vector<bool>& bed,
                             std::vector<double> sink)
    : mesh_(mesh),
      geometry_(mesh),
      faces_(mesh, geometry_, bed),
      projection_(foam, mesh, geometry_, bed),
      sink_(std::move(sink)),
      total_(std::accumulate(sink_.begin(), sink_.end(), 0.0)) {}

std::vector<double> SurrogateFlux::operator()(const std::vector<double>& share) {
  std::vector<double> flux(mesh_.faces(), 0.0);
  faces_.set_inflow(total_, flux, flux);
  projection_.project(share, sink_, tolerance * total_, acceptable * total_, flux);
  return flux;
}

}  // namespace cupola
