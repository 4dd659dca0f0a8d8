#include "schemas/field_file.hpp"

#include <fmt/format.h>

#include "schemas/failure.hpp"
#include "schemas/version.hpp"

namespace cupola {

namespace {

constexpr std::size_t points_per_cell = 8;
constexpr std::uint8_t vtk_hexahedron = 12;

Failure wrong(const HdfReader& file, const std::string& what) {
  return Failure(ExitCode::wrong_input, fmt::format("{}: {}", file.file().string(), what))
      .at("file", file.file().string());
}

}  // namespace

void write_header(HdfWriter& file, const FileHeader& header) {
  file.attribute("/", "schema", std::int64_t{file_schema_version});
  file.attribute("/", "kind", header.kind);
  file.attribute("/", "program_version", program_version);
  file.attribute("/", "campaign_hash", header.campaign_hash);
  if (!header.mesh_hash.empty()) {
    file.attribute("/", "mesh_hash", header.mesh_hash);
  }
}

FileHeader read_header(const HdfReader& file, const std::string& kind) {
  if (!file.has_attribute("/", "schema") || !file.has_attribute("/", "kind")) {
    throw wrong(file, "an HDF5 file, but not one of cupola's: it has no attributes 'schema' and 'kind'");
  }
  const std::int64_t schema = file.integer_attribute("/", "schema");
  if (schema > file_schema_version) {
    const std::string writer =
        file.has_attribute("/", "program_version") ? file.text_attribute("/", "program_version") : "unknown";
    throw wrong(
        file,
        fmt::format("written by cupola {} in file schema {}; this is cupola {}, which reads schemas up to {}: use the "
                    "newer program",
                    writer, schema, program_version, file_schema_version));
  }
  FileHeader header;
  header.kind = file.text_attribute("/", "kind");
  if (!kind.empty() && header.kind != kind) {
    throw wrong(file, fmt::format("a file of kind '{}', where '{}' is expected", header.kind, kind));
  }
  header.campaign_hash = file.text_attribute("/", "campaign_hash");
  if (file.has_attribute("/", "mesh_hash")) {
    header.mesh_hash = file.text_attribute("/", "mesh_hash");
  }
  return header;
}

void require_mesh(const HdfReader& file, const FileHeader& header, const std::string& mesh_hash) {
  if (header.mesh_hash != mesh_hash) {
    throw wrong(file, fmt::format("made on another mesh ({}) than this task's ({}): its cells cannot be matched",
                                  header.mesh_hash, mesh_hash))
        .at("mesh_hash", header.mesh_hash);
  }
}

FieldFileWriter::FieldFileWriter(const std::filesystem::path& file, const FileHeader& header,
                                 const std::vector<double>& points, const std::vector<std::int64_t>& cell_points)
    : hdf_(file), name_(file.string()), cells_(cell_points.size() / points_per_cell) {
  write_header(hdf_, header);
  hdf_.attribute("/VTKHDF", "Version", std::vector<std::int64_t>{1, 0});
  hdf_.attribute("/VTKHDF", "Type", "UnstructuredGrid");
  const auto count = [](std::size_t value) { return std::vector<std::int64_t>{static_cast<std::int64_t>(value)}; };
  hdf_.write("/VTKHDF/NumberOfPoints", count(points.size() / 3));
  hdf_.write("/VTKHDF/NumberOfCells", count(cells_));
  hdf_.write("/VTKHDF/NumberOfConnectivityIds", count(cell_points.size()));
  hdf_.write("/VTKHDF/Points", points, 3);
  hdf_.write("/VTKHDF/Connectivity", cell_points);
  std::vector<std::int64_t> offsets(cells_ + 1);
  for (std::size_t cell = 0; cell <= cells_; ++cell) {
    offsets[cell] = static_cast<std::int64_t>(cell * points_per_cell);
  }
  hdf_.write("/VTKHDF/Offsets", offsets);
  hdf_.write("/VTKHDF/Types", std::vector<std::uint8_t>(cells_, vtk_hexahedron));
}

void FieldFileWriter::cell_data(const std::string& name, const std::vector<double>& values, std::size_t columns) {
  if (values.size() != cells_ * columns) {
    throw Failure(ExitCode::input_output, fmt::format("{}: field '{}' has {} values for {} cells of {}", name_, name,
                                                      values.size(), cells_, columns));
  }
  hdf_.write("/VTKHDF/CellData/" + name, values, columns);
}

void FieldFileWriter::summary(const nlohmann::json& value) {
  hdf_.write_text("/Summary", value.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace));
}

FieldFile::FieldFile(const std::filesystem::path& file, const std::string& kind, const std::string& mesh_hash)
    : hdf_(file), header_(read_header(hdf_, kind)) {
  if (!mesh_hash.empty()) {
    require_mesh(hdf_, header_, mesh_hash);
  }
  const std::vector<std::int64_t> count = hdf_.integers("/VTKHDF/NumberOfCells", 1);
  const auto [stored, columns] = hdf_.shape("/VTKHDF/Types");
  if (count.front() < 0 || static_cast<std::size_t>(count.front()) != stored || columns != 1) {
    throw wrong(hdf_, fmt::format("says it has {} cells and lists {}: the file is damaged", count.front(), stored));
  }
  cells_ = stored;
}

std::vector<double> FieldFile::points() const { return hdf_.doubles("/VTKHDF/Points", -1, 3); }

std::vector<std::int64_t> FieldFile::cell_points() const {
  return hdf_.integers("/VTKHDF/Connectivity", static_cast<std::int64_t>(cells_ * points_per_cell), 1);
}

std::vector<std::string> FieldFile::cell_data_names() const { return hdf_.names("/VTKHDF/CellData"); }

bool FieldFile::has_cell_data(const std::string& name) const { return hdf_.has("/VTKHDF/CellData/" + name); }

std::vector<double> FieldFile::cell_data(const std::string& name, std::size_t columns) const {
  return hdf_.doubles("/VTKHDF/CellData/" + name, static_cast<std::int64_t>(cells_),
                      static_cast<std::int64_t>(columns));
}

nlohmann::json FieldFile::summary() const {
  if (!hdf_.has("/Summary")) {
    return nlohmann::json::object();
  }
  nlohmann::json value = nlohmann::json::parse(hdf_.text("/Summary"), nullptr, false);
  if (!value.is_object()) {
    throw Failure(ExitCode::input_output, fmt::format("{}: '/Summary' is not whole JSON", hdf_.file().string()));
  }
  return value;
}

}  // namespace cupola
