#include "tests/support/stated_bed.hpp"

#include <nlohmann/json.hpp>

#include "schemas/field_file.hpp"

namespace cupola::testing {
namespace {

std::vector<double> flat(const std::vector<Vector3>& vectors) {
  std::vector<double> rows;
  for (const Vector3& v : vectors) rows.insert(rows.end(), v.begin(), v.end());
  return rows;
}

}  // namespace

void StatedBed::add_parcel(std::int64_t of_species, const Vector3& where, double with_radius, double with_mass) {
  id.push_back(static_cast<std::int64_t>(id.size()) + 1);
  species.push_back(of_species);
  position.push_back(where);
  radius.push_back(with_radius);
  mass.push_back(with_mass);
}

StatedBed bed_at_rest(const BedMesh& mesh, const Campaign& campaign, double solids_fraction) {
  StatedBed bed;
  bed.solids_fraction.assign(mesh.cells(), 0.0);
  bed.solids_velocity.assign(mesh.cells(), Vector3{});
  const Species& species = campaign.species.front();
  for (std::size_t c = 0; c < mesh.cells(); ++c) {
    if (mesh.cell_centre[c][2] > campaign.charging.stock_line) continue;
    bed.solids_fraction[c] = solids_fraction;
    bed.add_parcel(0, mesh.cell_centre[c], species.parcel_diameter() / 2,
                   solids_fraction * mesh.cell_volume[c] * species.density);
  }
  return bed;
}

void write_stated_bed(const std::filesystem::path& file, const BedMesh& mesh, const Task& task, const StatedBed& bed) {
  std::vector<std::int64_t> cell_points;
  for (const auto& cell : mesh.cell_points) cell_points.insert(cell_points.end(), cell.begin(), cell.end());
  FieldFileWriter out(file, {"dem-result", task.campaign_hash, mesh.hash}, flat(mesh.points), cell_points);
  out.cell_data("solids_fraction", bed.solids_fraction);
  out.cell_data("solids_growth", std::vector<double>(bed.solids_fraction.size(), 0.0));
  out.cell_data("contact_fraction", bed.solids_fraction);
  out.cell_data("solids_velocity", flat(bed.solids_velocity), 3);
  out.hdf().write("Packing/id", bed.id);
  out.hdf().write("Packing/species", bed.species);
  out.hdf().write("Packing/position", flat(bed.position), 3);
  out.hdf().write("Packing/radius", bed.radius);
  out.hdf().write("Packing/mass", bed.mass);
  out.hdf().write("Charging/next_layer", std::vector<std::int64_t>{0});
  out.hdf().write("Charging/owed", std::vector<double>(task.campaign.species.size(), 0.0));
  out.summary({{"coke_removal_rate", bed.coke_removal_rate}, {"removal_by_raceway", bed.removal_by_raceway}});
  out.commit();
}

}  // namespace cupola::testing
