#pragma once
#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "schemas/hdf.hpp"

namespace cupola {

/// What every HDF5 file of ours says about itself, as attributes of its root.
struct FileHeader {
  std::string kind;           ///< `mesh`, `dem-result`, `tracer-result`, `checkpoint`
  std::string campaign_hash;  ///< of the frozen campaign file
  std::string mesh_hash;      ///< of `foam/mesh.hdf`; empty in the mesh file itself
};

/// Writes the header with this program's schema and version.
void write_header(HdfWriter& file, const FileHeader& header);

/// Reads the header of a file that should be of `kind` (empty: of any).
/// @throws Failure wrong_input: not a file of ours, of a newer schema or of another kind
FileHeader read_header(const HdfReader& file, const std::string& kind);

/// @throws Failure wrong_input where the file was made on another mesh
void require_mesh(const HdfReader& file, const FileHeader& header, const std::string& mesh_hash);

/// Writes a file of fields on a hexahedral mesh as VTKHDF 1.0 (serial UnstructuredGrid, one partition), which ParaView
/// opens.
class FieldFileWriter {
 public:
  /// @param points       n x 3, m
  /// @param cell_points  cells x 8, in VTK's order of a hexahedron (lower ring, upper ring)
  FieldFileWriter(const std::filesystem::path& file, const FileHeader& header, const std::vector<double>& points,
                  const std::vector<std::int64_t>& cell_points);

  [[nodiscard]] std::size_t cells() const { return cells_; }
  /// A field, cells x columns, row-major, in undecomposed cell order. @throws Failure where the length is another
  void cell_data(const std::string& name, const std::vector<double>& values, std::size_t columns = 1);
  /// `/Summary`: the numbers a report needs.
  void summary(const nlohmann::json& value);
  /// For groups that are not fields.
  [[nodiscard]] HdfWriter& hdf() { return hdf_; }
  /// Syncs and renames; without it nothing is left.
  void commit() { hdf_.commit(); }

 private:
  HdfWriter hdf_;
  std::string name_;
  std::size_t cells_ = 0;
};

/// Reads such a file.
class FieldFile {
 public:
  /// @param kind       what it must be
  /// @param mesh_hash  the mesh it must belong to; empty: any
  /// @throws Failure input_output: missing, truncated; wrong_input: of a newer schema, another kind or another mesh
  FieldFile(const std::filesystem::path& file, const std::string& kind, const std::string& mesh_hash = "");

  [[nodiscard]] const FileHeader& header() const { return header_; }
  [[nodiscard]] std::size_t cells() const { return cells_; }
  [[nodiscard]] std::vector<double> points() const;             ///< n x 3, m
  [[nodiscard]] std::vector<std::int64_t> cell_points() const;  ///< cells x 8
  [[nodiscard]] std::vector<std::string> cell_data_names() const;
  [[nodiscard]] bool has_cell_data(const std::string& name) const;
  /// @throws Failure wrong_input where the field is missing or of another shape
  [[nodiscard]] std::vector<double> cell_data(const std::string& name, std::size_t columns = 1) const;
  /// `/Summary`; an empty object where there is none. @throws Failure input_output where it is not whole JSON
  [[nodiscard]] nlohmann::json summary() const;
  [[nodiscard]] const HdfReader& hdf() const { return hdf_; }

 private:
  HdfReader hdf_;
  FileHeader header_;
  std::size_t cells_ = 0;
};

}  // namespace cupola
