#pragma once
#include <sys/types.h>

#include <filesystem>
#include <functional>
#include <string>

#include "physics/mesh/bed_mesh.hpp"
#include "schemas/campaign.hpp"
#include "schemas/field_file.hpp"
#include "schemas/task.hpp"
#include "tests/support/stated_bed.hpp"
#include "tests/support/temporary_folder.hpp"

namespace cupola::testing {

using MakeBed = std::function<StatedBed(const BedMesh&, const Campaign&)>;

/// Tracers of a result, sorted by id.
struct FinalTracers {
  std::vector<std::int64_t> id, species;
  std::vector<Vector3> position;
  std::vector<double> volume, temperature;  ///< temperature empty in a cold scene
};

/// `cupola-tracer` on a task folder of its own, with the campaign's mesh and a DEM result that is stated or generated
/// (write_settled_bed): the program as it is installed, under mpiexec on more than one rank.
class TracerProgram {
 public:
  /// @throws std::runtime_error where `prepare` fails
  explicit TracerProgram(const Campaign& campaign, int ranks = 1);
  TracerProgram(const Campaign& campaign, const MakeBed& make_bed, int ranks = 1);

  [[nodiscard]] const std::filesystem::path& path() const { return folder_.path(); }
  [[nodiscard]] const BedMesh& mesh() const { return mesh_; }

  /// Starts the program; `wait` gives its exit status.
  [[nodiscard]] pid_t start() const;
  static int wait(pid_t child);
  int run() const { return wait(start()); }

  /// Another march on the same mesh: drops what the last one left behind and takes the tracer settings, species, heat
  /// and temperatures of `campaign`.
  void march_anew(const Campaign& campaign);
  /// The same with another DEM result.
  void march_anew(const Campaign& campaign, const StatedBed& bed);
  /// Begins from the solids temperature of a tracer result (copied from `file`).
  void begin_from(const std::filesystem::path& file);
  /// Takes the DEM result of another task.
  void take_granular(const std::filesystem::path& file);
  /// The same task with the mesh decomposed for another number of ranks; what a march left behind stays.
  void change_ranks(int ranks);

  [[nodiscard]] FieldFile result() const { return {path() / "result.hdf", "tracer-result"}; }
  [[nodiscard]] FinalTracers tracers() const;
  /// Message and place of `failure.json`; empty where there is none.
  [[nodiscard]] std::string failure() const;

 private:
  void prepare();
  void drop_march();
  void set_bed(const StatedBed& bed);

  TemporaryFolder folder_;
  Task task_;
  int ranks_;
  BedMesh mesh_;
};

}  // namespace cupola::testing
