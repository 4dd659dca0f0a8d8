#include <dlfcn.h>
#include <gmock/gmock.h>

#include <cstdlib>
#include <functional>
#include <iostream>

#include "orchestrator/run_folder.hpp"
#include "orchestrator/stage_state.hpp"
#include "physics/mesh/bed_mesh.hpp"
#include "schemas/checkpoint_seal.hpp"
#include "schemas/field_file.hpp"
#include "schemas/files.hpp"
#include "schemas/task.hpp"
#include "tests/support/temporary_folder.hpp"

/// A disk that fails once (EIO): whichever read or write it is, of whichever file of a real run (environment
/// CUPOLA_FAULT_RUN), it is said with status 74, the file's name and the system's reason; never is the file taken for
/// another, an empty or a shorter one, and nothing is lost in silence.  Runs with tests/fault/fault_shim.c preloaded.
namespace {

namespace fs = std::filesystem;
using cupola::Failure;
using testing::HasSubstr;

/// The preloaded library's switch.
struct Disk {
  using Arm = void (*)(const char*, const char*, long);
  using Count = long (*)();
  Arm arm = reinterpret_cast<Arm>(dlsym(RTLD_DEFAULT, "cupola_fault_arm"));
  Count reads = reinterpret_cast<Count>(dlsym(RTLD_DEFAULT, "cupola_fault_reads"));
  Count changes = reinterpret_cast<Count>(dlsym(RTLD_DEFAULT, "cupola_fault_changes"));
};

/// Every dataset and the header of a file of fields.
void read_fields(const fs::path& file) {
  const cupola::FieldFile fields(file, "");
  static_cast<void>(fields.points());
  static_cast<void>(fields.cell_points());
  static_cast<void>(fields.summary());
  for (const auto& name : fields.cell_data_names())
    static_cast<void>(fields.cell_data(name, fields.hdf().shape("/VTKHDF/CellData/" + name).second));
  for (const char* group : {"Packing", "Tracers"})
    for (const auto& name : fields.hdf().names(group)) {
      const std::string path = std::string(group) + "/" + name;
      if (name == "id" || name == "species" || name == "released") {
        static_cast<void>(fields.hdf().integers(path));
      } else {
        static_cast<void>(fields.hdf().doubles(path));
      }
    }
}

class DiskErrors : public testing::Test {
 protected:
  void SetUp() override {
    const char* run = std::getenv("CUPOLA_FAULT_RUN");
    ASSERT_NE(run, nullptr) << "CUPOLA_FAULT_RUN names the run folder of the undisturbed campaign";
    run_ = run;
    ASSERT_NE(disk_.arm, nullptr) << "the library of faults is not preloaded";
  }

  /// Each read that `work` makes fails once. @return how many there are
  long fail_each_read(const std::function<void()>& work) {
    disk_.arm(run_.c_str(), "read-eio", 0);
    work();
    const long reads = disk_.reads();
    for (long read = 1; read <= reads; ++read) {
      disk_.arm(run_.c_str(), "read-eio", read);
      try {
        work();
        ADD_FAILURE() << "read " << read << " of " << reads << " failed, and nothing is said";
      } catch (const Failure& failure) {
        EXPECT_EQ(failure.code(), cupola::ExitCode::input_output) << failure.what();
        EXPECT_THAT(failure.what(), HasSubstr(run_.string()));
        EXPECT_THAT(failure.what(), HasSubstr("Input/output error"));
      }
    }
    disk_.arm(run_.c_str(), "", 0);
    EXPECT_GT(reads, 0);
    return reads;
  }

  Disk disk_;
  fs::path run_;
};

TEST_F(DiskErrors, OfEveryReadAreSaid) {
  const fs::path dem = run_ / "episodes/001/dem/attempt-1";
  const fs::path tracer = run_ / "episodes/002/tracer/attempt-1";
  long reads = 0;
  reads += fail_each_read([&] { static_cast<void>(cupola::BedMesh::read(dem / "foam/mesh.hdf")); });
  reads += fail_each_read([&] { read_fields(dem / "result.hdf"); });
  reads += fail_each_read([&] { read_fields(tracer / "result.hdf"); });
  reads += fail_each_read([&] { cupola::verify_manifest(dem); });
  reads += fail_each_read([&] { static_cast<void>(cupola::read_task(tracer)); });
  reads += fail_each_read([&] { static_cast<void>(cupola::find_checkpoints(dem)); });
  reads += fail_each_read([&] { static_cast<void>(cupola::read_run(run_)); });
  reads += fail_each_read([&] { static_cast<void>(cupola::RunFolder::open(run_)); });
  std::cout << reads << " of " << reads << " failed reads said\n";
}

TEST_F(DiskErrors, OfEveryWriteOfAFieldFileAreSaid) {
  const cupola::BedMesh mesh = cupola::BedMesh::read(run_ / "episodes/001/dem/attempt-1/foam/mesh.hdf");
  const cupola::TemporaryFolder temporary;
  const fs::path file = temporary.path() / "mesh.hdf";
  mesh.write(file, "campaign");
  const std::string whole = cupola::hash_file(file);
  long said = 0;
  for (long change = 1;; ++change) {
    fs::remove(file);
    disk_.arm(temporary.path().c_str(), "eio", change);
    try {
      mesh.write(file, "campaign");
      const bool beyond_the_last = disk_.changes() < change;
      disk_.arm(temporary.path().c_str(), "", 0);
      EXPECT_EQ(cupola::hash_file(file), whole) << "change " << change << " failed, and nothing is said";
      if (beyond_the_last) break;
    } catch (const Failure& failure) {
      disk_.arm(temporary.path().c_str(), "", 0);
      EXPECT_EQ(failure.code(), cupola::ExitCode::input_output) << failure.what();
      EXPECT_THAT(failure.what(), HasSubstr(temporary.path().string()));
      ++said;
    }
  }
  EXPECT_GT(said, 10);
  std::cout << said << " failed writes said\n";
}

}  // namespace
