#include <gmock/gmock.h>

#include "raw_files.hpp"
#include "schemas/field_file.hpp"
#include "schemas/version.hpp"

namespace cupola {
namespace {

using test::failure_of;
using testing::ElementsAre;
using testing::HasSubstr;

/// Two unit cubes side by side along x.
const std::vector<double> points = [] {
  std::vector<double> flat;
  for (int z = 0; z < 2; ++z) {
    for (int y = 0; y < 2; ++y) {
      for (int x = 0; x < 3; ++x) {
        flat.insert(flat.end(), {double(x), double(y), double(z)});
      }
    }
  }
  return flat;
}();
const std::vector<std::int64_t> cell_points{0, 1, 4, 3, 6, 7, 10, 9, 1, 2, 5, 4, 7, 8, 11, 10};

class FieldFiles : public testing::Test {
 protected:
  void write(const FileHeader& header) const {
    FieldFileWriter writer(file, header, points, cell_points);
    writer.cell_data("solids_fraction", {0.5, 0.6});
    writer.cell_data("solids_velocity", {0, 0, -1, 0, 0, -2}, 3);
    writer.hdf().write("Packing/id", std::vector<std::int64_t>{4, 5});
    writer.summary({{"parcels", 2}, {"time_step", 1e-5}});
    writer.commit();
  }

  TemporaryFolder folder;
  std::filesystem::path file = folder.path() / "result.hdf";
  FileHeader header{"dem-result", "xxh3:c", "xxh3:m"};
};

TEST_F(FieldFiles, GiveBackWhatWasWritten) {
  write(header);
  const FieldFile read(file, "dem-result", "xxh3:m");
  EXPECT_EQ(read.cells(), 2U);
  EXPECT_EQ(read.points(), points);
  EXPECT_EQ(read.cell_points(), cell_points);
  EXPECT_THAT(read.cell_data_names(), ElementsAre("solids_fraction", "solids_velocity"));
  EXPECT_THAT(read.cell_data("solids_fraction"), ElementsAre(0.5, 0.6));
  EXPECT_THAT(read.cell_data("solids_velocity", 3), ElementsAre(0, 0, -1, 0, 0, -2));
  EXPECT_FALSE(read.has_cell_data("gas_pressure"));
  EXPECT_EQ(read.summary().at("parcels"), 2);
  EXPECT_EQ(read.header().campaign_hash, "xxh3:c");
  EXPECT_THAT(read.hdf().integers("Packing/id"), ElementsAre(4, 5));
}

/// The layout that VTK's reader of version 1.0 asks for.
TEST_F(FieldFiles, AreVtkhdf) {
  write(header);
  const HdfReader hdf(file);
  EXPECT_EQ(hdf.text_attribute("VTKHDF", "Type"), "UnstructuredGrid");
  EXPECT_THAT(hdf.integers("VTKHDF/NumberOfPoints", 1), ElementsAre(12));
  EXPECT_THAT(hdf.integers("VTKHDF/NumberOfCells", 1), ElementsAre(2));
  EXPECT_THAT(hdf.integers("VTKHDF/NumberOfConnectivityIds", 1), ElementsAre(16));
  EXPECT_THAT(hdf.integers("VTKHDF/Offsets"), ElementsAre(0, 8, 16));
  EXPECT_THAT(hdf.bytes("VTKHDF/Types"), ElementsAre(12, 12));
}

TEST_F(FieldFiles, RefuseAnotherKindMeshOrShape) {
  write(header);
  const Failure kind = failure_of([&] { FieldFile(file, "tracer-result"); });
  EXPECT_EQ(kind.code(), ExitCode::wrong_input);
  EXPECT_THAT(kind.what(), HasSubstr("kind 'dem-result', where 'tracer-result' is expected"));
  const Failure mesh = failure_of([&] { FieldFile(file, "dem-result", "xxh3:other"); });
  EXPECT_EQ(mesh.code(), ExitCode::wrong_input);
  EXPECT_THAT(mesh.what(), HasSubstr("another mesh"));
  const FieldFile read(file, "dem-result");
  EXPECT_THAT(failure_of([&] { (void)read.cell_data("solids_velocity"); }).what(), HasSubstr("3 columns where 1"));
  EXPECT_THAT(failure_of([&] { (void)read.cell_data("gas_pressure"); }).what(), HasSubstr("gas_pressure"));
}

TEST_F(FieldFiles, RefuseANewerSchemaAndForeignFiles) {
  {
    HdfWriter writer(file);
    writer.attribute("/", "schema", std::int64_t{file_schema_version + 1});
    writer.attribute("/", "kind", "dem-result");
    writer.attribute("/", "program_version", "9.0.0");
    writer.commit();
  }
  const Failure newer = failure_of([&] { FieldFile(file, "dem-result"); });
  EXPECT_EQ(newer.code(), ExitCode::wrong_input);
  EXPECT_THAT(newer.what(), HasSubstr("written by cupola 9.0.0 in file schema 2"));
  {
    HdfWriter writer(file);
    writer.write("data", std::vector<double>{1});
    writer.commit();
  }
  EXPECT_THAT(failure_of([&] { FieldFile(file, "dem-result"); }).what(), HasSubstr("not one of cupola's"));
}

TEST_F(FieldFiles, AFieldOfAnotherLengthIsRefused) {
  FieldFileWriter writer(file, header, points, cell_points);
  EXPECT_THAT(failure_of([&] { writer.cell_data("solids_fraction", {1, 2, 3}); }).what(), HasSubstr("solids_fraction"));
}

}  // namespace
}  // namespace cupola
