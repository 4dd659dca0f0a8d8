#pragma once
#include <filesystem>
#include <string>

#include "physics/mesh/bed_mesh.hpp"
#include "physics/mesh/foam_case.hpp"
#include "physics/mesh/prepare.hpp"
#include "physics/projection/bed_state.hpp"
#include "schemas/files.hpp"
#include "schemas/task.hpp"
#include "tests/support/temporary_folder.hpp"

namespace cupola {

inline Task task_of(const Campaign& campaign) {
  Task task;
  task.campaign = campaign;
  task.campaign_hash = hash_text(campaign.name);
  task.program_version = "test";
  return task;
}

/// OpenFOAM and the mesh of a campaign on one rank, in a folder of their own.
class FoamScene {
 public:
  explicit FoamScene(const Campaign& campaign)
      : folder_(campaign),
        foam(folder_.path() / "foam", argc_, argv_),
        mesh(BedMesh::read(folder_.path() / "foam" / "mesh.hdf")) {}

 private:
  struct Prepared : TemporaryFolder {
    explicit Prepared(const Campaign& campaign) { prepare(path(), task_of(campaign)); }
  };
  Prepared folder_;
  char name_[7] = "cupola";
  char* words_[2] = {name_, nullptr};
  int argc_ = 1;
  char** argv_ = words_;

 public:
  FoamCase foam;
  BedMesh mesh;
};

/// The same bed in every cell.
inline BedState uniform_bed(const BedMesh& mesh, double void_fraction, double grain_diameter) {
  BedState bed;
  bed.void_fraction.assign(mesh.cells(), void_fraction);
  bed.grain_diameter.assign(mesh.cells(), grain_diameter);
  bed.drag_factor.assign(mesh.cells(), 1);
  return bed;
}

}  // namespace cupola
