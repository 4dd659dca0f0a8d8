#include "orchestrator/report/paraview_views.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <numeric>
#include <set>
#include <string>

#include "schemas/field_file.hpp"
#include "schemas/files.hpp"

namespace cupola {
namespace {

/// Datasets of whole numbers; all others hold doubles.
bool holds_integers(const std::string& dataset) {
  static const std::set<std::string> integers = {"Packing/id", "Packing/species", "Packing/released",
                                                 "Tracers/id", "Tracers/species", "VTKHDF/Connectivity"};
  return integers.contains(dataset);
}

/// A dataset of a result, as XDMF names it.
class DataItems {
 public:
  DataItems(const HdfReader& file, std::string path) : file_(file), path_(std::move(path)) {}

  /// @param columns the shape to show; 0: the dataset's own
  [[nodiscard]] std::string item(const std::string& dataset, std::size_t columns = 0) const {
    auto [rows, own_columns] = file_.shape(dataset);
    if (columns > 0) {
      rows = rows * own_columns / columns;
      own_columns = columns;
    }
    const std::string size = own_columns > 1 ? fmt::format("{} {}", rows, own_columns) : std::to_string(rows);
    return fmt::format(R"(<DataItem Dimensions="{}" NumberType="{}" Precision="8" Format="HDF">{}:/{}</DataItem>)",
                       size, holds_integers(dataset) ? "Int" : "Float", path_, dataset);
  }

  [[nodiscard]] std::string attribute(const std::string& name, const std::string& dataset, const char* centre) const {
    const bool vector = file_.shape(dataset).second == 3;
    return fmt::format("        <Attribute Name=\"{}\" AttributeType=\"{}\" Center=\"{}\">{}</Attribute>\n", name,
                       vector ? "Vector" : "Scalar", centre, item(dataset));
  }

  [[nodiscard]] const HdfReader& file() const { return file_; }

 private:
  const HdfReader& file_;
  std::string path_;
};

/// The mesh with its cell fields.
std::string mesh_grid(const DataItems& items) {
  constexpr std::size_t corners = 8;
  const std::size_t cells = items.file().shape("VTKHDF/Connectivity").first / corners;
  std::string text = fmt::format(
      "        <Topology TopologyType=\"Hexahedron\" NumberOfElements=\"{}\">{}</Topology>\n"
      "        <Geometry GeometryType=\"XYZ\">{}</Geometry>\n",
      cells, items.item("VTKHDF/Connectivity", corners), items.item("VTKHDF/Points"));
  for (const std::string& name : items.file().names("VTKHDF/CellData"))
    text += items.attribute(name, "VTKHDF/CellData/" + name, "Cell");
  return text;
}

constexpr const char* vertex_file = "vertices.hdf";

/// Numbers for so many points: a dataset of exactly that length, since ParaView's older reader crashes on a longer one.
std::string vertex_dataset(std::size_t points) { return fmt::format("first_{}", points); }

/// The points of a group, such as `Tracers`, with their properties.  ParaView draws cells: each point is one, and these
/// cells want numbers, which the results do not hold.
std::string point_grid(const DataItems& items, const std::string& group) {
  const std::size_t points = items.file().shape(group + "/position").first;
  std::string text = fmt::format(
      "        <Topology TopologyType=\"Polyvertex\" NumberOfElements=\"{0}\" NodesPerElement=\"1\">"
      R"(<DataItem Dimensions="{0}" NumberType="Int" Precision="8" Format="HDF">{1}:/{2}</DataItem>)"
      "</Topology>\n        <Geometry GeometryType=\"XYZ\">{3}</Geometry>\n",
      points, vertex_file, vertex_dataset(points), items.item(group + "/position"));
  for (const std::string& name : items.file().names(group))
    if (name != "position") text += items.attribute(name, group + "/" + name, "Node");
  return text;
}

/// The numbers 0, 1, 2 … for each of these counts of points.
void write_vertices(const std::filesystem::path& file_name, const std::set<std::size_t>& counts) {
  HdfWriter file(file_name);
  for (const std::size_t count : counts) {
    std::vector<std::int64_t> numbers(count);
    std::iota(numbers.begin(), numbers.end(), std::int64_t{0});
    file.write(vertex_dataset(count), numbers);
  }
  file.commit();
}

/// One time series over the episodes. @param needed what a result must hold to be in it
void write_series(const std::filesystem::path& run, const std::vector<StageReport>& stages, TaskKind kind,
                  const std::string& name, const std::string& needed,
                  const std::function<std::string(const DataItems&)>& grid) {
  std::string grids;
  for (const StageReport& stage : stages) {
    if (stage.kind != kind || !stage.readable) continue;
    const HdfReader file(stage.result());
    if (!file.has(needed)) continue;
    const DataItems items(file, "../" + stage.result().lexically_relative(run).string());
    grids += fmt::format(
        "      <Grid Name=\"episode {}\" GridType=\"Uniform\">\n        <Time Value=\"{}\"/>\n{}      </Grid>\n",
        stage.episode, stage.episode, grid(items));
  }
  if (grids.empty()) return;
  write_text_atomically(
      run / "fields" / (name + ".xdmf"),
      fmt::format("<?xml version=\"1.0\" encoding=\"utf-8\"?>\n<Xdmf Version=\"3.0\">\n  <Domain>\n    "
                  "<Grid Name=\"{}\" GridType=\"Collection\" CollectionType=\"Temporal\">\n{}    "
                  "</Grid>\n  </Domain>\n</Xdmf>\n",
                  name, grids));
}

}  // namespace

void write_paraview_views(const std::filesystem::path& run_folder, const std::vector<StageReport>& stages) {
  std::error_code error;
  std::filesystem::create_directories(run_folder / "fields", error);
  if (error)
    throw Failure(ExitCode::input_output,
                  fmt::format("{}: cannot be made: {}", (run_folder / "fields").string(), error.message()));
  std::set<std::size_t> counts;
  const auto points = [&counts](const std::string& group) {
    return [&counts, group](const DataItems& items) {
      counts.insert(items.file().shape(group + "/position").first);
      return point_grid(items, group);
    };
  };
  write_series(run_folder, stages, TaskKind::dem, "dem_fields", "VTKHDF/Points", mesh_grid);
  write_series(run_folder, stages, TaskKind::tracer, "tracer_fields", "VTKHDF/Points", mesh_grid);
  write_series(run_folder, stages, TaskKind::dem, "parcels", "Packing/position", points("Packing"));
  write_series(run_folder, stages, TaskKind::tracer, "tracers", "Tracers/position", points("Tracers"));
  if (!counts.empty()) write_vertices(run_folder / "fields" / vertex_file, counts);
}

}  // namespace cupola
