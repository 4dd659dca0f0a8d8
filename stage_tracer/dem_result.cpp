#include "stage_tracer/dem_result.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "schemas/failure.hpp"
#include "schemas/field_file.hpp"

namespace cupola {
namespace {

void require_finite(const std::vector<double>& values, const std::string& name, const std::filesystem::path& file) {
  const auto bad = std::find_if(values.begin(), values.end(), [](double v) { return !std::isfinite(v); });
  if (bad == values.end()) return;
  throw Failure(
      ExitCode::wrong_input,
      fmt::format("{} in {} holds a value that is not a number; run the DEM stage again", name, file.string()))
      .at("entry", std::to_string(bad - values.begin()));
}

/// Above this a cell holds what no packing and no coarse projection can explain.  A little more than 1 is seen in
/// single cells where softened parcels overlap (cases/tiny: 1.10): the gas has least_void_fraction there, and the cell
/// is counted.
constexpr double most_solids_fraction = 1.25;

/// Grains leave a part of every cell to the gas.
void require_gas_in_every_cell(const std::vector<double>& solids_fraction, const BedMesh& mesh,
                               const std::filesystem::path& file) {
  const auto bad = std::find_if(solids_fraction.begin(), solids_fraction.end(),
                                [](double f) { return f < 0 || f >= most_solids_fraction; });
  if (bad == solids_fraction.end()) return;
  const auto cell = static_cast<std::size_t>(bad - solids_fraction.begin());
  const Vector3& at = mesh.cell_centre[cell];
  throw Failure(
      ExitCode::wrong_input,
      fmt::format("solids_fraction in {} is {:.4g} in the cell at ({:.4g}, {:.4g}, {:.4g}) m: it leaves no gas "
                  "there (expected 0 to 1); run the DEM stage again, with stiffer contacts if its "
                  "report shows large overlaps",
                  file.string(), *bad, at[0], at[1], at[2]))
      .at("cell", std::to_string(cell));
}

std::vector<Vector3> vectors(const std::vector<double>& rows) {
  std::vector<Vector3> result(rows.size() / 3);
  for (std::size_t i = 0; i < result.size(); ++i) result[i] = {rows[3 * i], rows[3 * i + 1], rows[3 * i + 2]};
  return result;
}

Packing read_packing(const HdfReader& hdf, const Campaign& campaign) {
  const std::vector<std::int64_t> id = hdf.integers("Packing/id");
  const auto count = static_cast<std::int64_t>(id.size());
  const std::vector<std::int64_t> species = hdf.integers("Packing/species", count);
  const std::vector<double> positions = hdf.doubles("Packing/position", count, 3);
  require_finite(positions, "Packing/position", hdf.file());
  const std::vector<Vector3> position = vectors(positions);
  const std::vector<double> radius = hdf.doubles("Packing/radius", count);
  const std::vector<double> mass = hdf.doubles("Packing/mass", count);
  std::vector<std::size_t> order(id.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return id[a] < id[b]; });
  Packing packing;
  for (const std::size_t i : order) {
    if (species[i] < 0 || species[i] >= static_cast<std::int64_t>(campaign.species.size()) || !(mass[i] > 0) ||
        !(radius[i] > 0)) {
      throw Failure(ExitCode::wrong_input,
                    fmt::format("parcel {} in {} has no valid species, mass or radius", id[i], hdf.file().string()))
          .at("parcel", std::to_string(id[i]));
    }
    packing.id.push_back(id[i]);
    packing.species.push_back(static_cast<std::uint8_t>(species[i]));
    packing.position.push_back(position[i]);
    packing.radius.push_back(radius[i]);
    packing.mass.push_back(mass[i]);
  }
  if (packing.id.empty()) {
    throw Failure(ExitCode::wrong_input,
                  fmt::format("{} holds no parcel; there is nothing to seed tracers from", hdf.file().string()));
  }
  return packing;
}

}  // namespace

DemResult read_dem_result(const std::filesystem::path& file, const BedMesh& mesh, const Campaign& campaign) {
  const FieldFile fields(file, "dem-result", mesh.hash);
  DemResult result;
  const auto field = [&](const std::string& name, std::size_t columns) {
    std::vector<double> values = fields.cell_data(name, columns);
    require_finite(values, name, file);
    return values;
  };
  result.solids_fraction = field("solids_fraction", 1);
  require_gas_in_every_cell(result.solids_fraction, mesh, file);
  result.solids_growth = field("solids_growth", 1);
  result.contact_fraction = field("contact_fraction", 1);
  result.solids_velocity = vectors(field("solids_velocity", 3));
  result.packing = read_packing(fields.hdf(), campaign);
  const std::size_t layers = std::max<std::size_t>(campaign.charging.layers.size(), 1);
  result.owed.assign(campaign.species.size(), 0.0);
  if (fields.hdf().has("Charging/next_layer")) {
    result.next_layer =
        static_cast<std::size_t>(std::max<std::int64_t>(fields.hdf().integers("Charging/next_layer").at(0), 0)) %
        layers;
    result.owed = fields.hdf().doubles("Charging/owed", static_cast<std::int64_t>(campaign.species.size()));
  }
  const nlohmann::json summary = fields.summary();
  result.persistent_removal_rate = summary.value("coke_removal_rate", 0.0);
  result.removal_by_raceway = summary.value("removal_by_raceway", std::vector<double>{});
  return result;
}

}  // namespace cupola
