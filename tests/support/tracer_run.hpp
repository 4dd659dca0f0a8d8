#pragma once
#include <filesystem>
#include <optional>
#include <string>

#include "schemas/field_file.hpp"
#include "schemas/files.hpp"
#include "schemas/task.hpp"
#include "tests/support/temporary_folder.hpp"

namespace cupola::testing {

/// The tracer stage's program run to its end on one rank, on a generated bed (`write_settled_bed`).
class TracerRun {
 public:
  /// Prepares the mesh, writes the bed and marches. @param program path of cupola-tracer
  TracerRun(const std::string& program, const Campaign& campaign);

  [[nodiscard]] int status() const { return status_; }
  [[nodiscard]] double wall_seconds() const { return wall_seconds_; }
  [[nodiscard]] FieldFile result() const { return {folder_.path() / "result.hdf", "tracer-result"}; }
  /// The sentence of failure.json; empty where there is none.
  [[nodiscard]] std::string sentence() const;

 private:
  TemporaryFolder folder_;
  int status_ = -1;
  double wall_seconds_ = 0;
};

}  // namespace cupola::testing
