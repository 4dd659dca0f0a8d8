#include "physics/mesh/foam_case.hpp"

#include <Time.H>
#include <argList.H>
#include <fmt/format.h>
#include <fvMesh.H>
#include <labelIOList.H>
#include <mpi.h>
#include <processorCyclicPolyPatch.H>
#include <processorPolyPatch.H>
#include <sigFpe.H>
#include <sigInt.H>
#include <sigQuit.H>
#include <sigSegv.H>

#include <algorithm>
#include <optional>
#include <string>

#include "physics/mesh/foam_errors.hpp"
#include "schemas/plain_path.hpp"

namespace cupola {
namespace {

/// MPI from the first use to the end of the process.
class MpiSession {
 public:
  static void begin(int& argc, char**& argv) { static const MpiSession session(argc, argv); }
  MpiSession(const MpiSession&) = delete;
  MpiSession& operator=(const MpiSession&) = delete;

 private:
  MpiSession(int& argc, char**& argv) {
    int running = 0;
    MPI_Initialized(&running);
    if (running != 0) return;
    // A rank that waits lets others run: ranks share the cores with each other and with the rest of the machine, and
    // one that spins keeps the one it waits for off its core (measured: 40 times slower on a busy machine).
    setenv("OMPI_MCA_mpi_yield_when_idle", "1", 0);
    MPI_Init(&argc, &argv);
  }
  ~MpiSession() {
    int over = 0;
    MPI_Finalized(&over);
    if (over == 0) MPI_Finalize();
  }
};

void check_decomposition(const std::filesystem::path& folder, int ranks) {
  if (!std::filesystem::exists(folder / "constant" / "polyMesh" / "points")) {
    throw Failure(ExitCode::wrong_input,
                  fmt::format("{} holds no mesh; run 'prepare' on the task first", folder.string()));
  }
  int parts = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.path().filename().string().starts_with("processor")) ++parts;
  }
  if (std::max(parts, 1) != ranks) {
    throw Failure(ExitCode::wrong_input,
                  fmt::format("{} is prepared for {} ranks and was started on {}; set launch.ranks "
                              "and run 'prepare' again, or start it on {}",
                              folder.string(), std::max(parts, 1), ranks, std::max(parts, 1)))
        .at("key", "launch.ranks");
  }
}

std::vector<std::int64_t> read_addressing(const Foam::fvMesh& mesh, const char* name) {
  const Foam::labelIOList list(Foam::IOobject(name, mesh.facesInstance(), Foam::polyMesh::meshSubDir, mesh,
                                              Foam::IOobject::MUST_READ, Foam::IOobject::NO_WRITE, false));
  return {list.begin(), list.end()};
}

std::int64_t largest_everywhere(std::int64_t value) {
  MPI_Allreduce(MPI_IN_PLACE, &value, 1, MPI_INT64_T, MPI_MAX, MPI_COMM_WORLD);
  return value;
}

/// argList takes the signals: floating-point traps end the process where our own checks say which cell, and an
/// interrupt would not reach the program's request to stop.
void leave_signals_alone() {
  Foam::sigFpe::unset();
  Foam::sigInt::unset();
  Foam::sigQuit::unset();
  Foam::sigSegv::unset();
}

}  // namespace

struct FoamCase::State {
  State(const std::filesystem::path& folder, int& argc, char**& argv) {
    MpiSession::begin(argc, argv);
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    MPI_Comm_size(MPI_COMM_WORLD, &ranks);
    check_decomposition(folder, ranks);
    start_foam(folder, argc > 0 ? argv[0] : "cupola");
    read_addressings();
  }

  // OpenFOAM ends the process with status 0 when its argList is destroyed; the exit status is ours to give, so it
  // stays.
  ~State() {
    mesh.reset();
    time.reset();
    static_cast<void>(arguments.release());
  }
  State(const State&) = delete;
  State& operator=(const State&) = delete;

  void start_foam(const std::filesystem::path& folder, const std::string& program) {
    with_foam_errors(ExitCode::input_output, fmt::format("OpenFOAM cannot read {}", folder.string()), [&] {
      Foam::messageStream::level = 0;
      Foam::fileName::debug = 0;  // else it ends the program over a blank in the name of the folder it is started in
      Foam::argList::noBanner();
      plain_folder.emplace(folder);
      words = {program, "-case", plain_folder->path().string(), "-noFunctionObjects"};
      if (ranks > 1) words.emplace_back("-parallel");
      for (std::string& word : words) word_pointers.push_back(word.data());
      word_pointers.push_back(nullptr);
      foam_argc = static_cast<int>(words.size());
      foam_argv = word_pointers.data();
      arguments = std::make_unique<Foam::argList>(foam_argc, foam_argv, true, true, false);
      leave_signals_alone();
      time = std::make_unique<Foam::Time>(Foam::Time::controlDictName, *arguments);
      mesh = std::make_unique<Foam::fvMesh>(
          Foam::IOobject(Foam::fvMesh::defaultRegion, time->timeName(), *time, Foam::IOobject::MUST_READ));
    });
  }

  void read_addressings() {
    const auto local_cells = static_cast<std::size_t>(mesh->nCells());
    const auto local_faces = static_cast<std::size_t>(mesh->nFaces());
    face_sign.assign(local_faces, 1);
    counts_face.assign(local_faces, true);
    if (ranks == 1) {
      for (std::size_t i = 0; i < local_cells; ++i) global_cell.push_back(static_cast<std::int64_t>(i));
      for (std::size_t i = 0; i < local_faces; ++i) global_face.push_back(static_cast<std::int64_t>(i));
    } else {
      with_foam_errors(ExitCode::input_output, "OpenFOAM cannot read the decomposition", [&] {
        global_cell = read_addressing(*mesh, "cellProcAddressing");
        global_face = read_addressing(*mesh, "faceProcAddressing");  // counted from 1, negative where turned round
      });
      for (std::int64_t& face : global_face) face = std::abs(face) - 1;
      find_turned_faces(read_addressing(*mesh, "faceProcAddressing"));
    }
    all_cells = static_cast<std::size_t>(
        largest_everywhere(global_cell.empty() ? 0 : *std::max_element(global_cell.begin(), global_cell.end()) + 1));
    all_faces = static_cast<std::size_t>(
        largest_everywhere(global_face.empty() ? 0 : *std::max_element(global_face.begin(), global_face.end()) + 1));
  }

  /// A face between two ranks is on both, turned round on the neighbour's; the owner's counts.  Faces of a periodic
  /// side cut between ranks are two faces of the whole mesh as well, each looking out of its own cell.
  void find_turned_faces(const std::vector<std::int64_t>& addressing) {
    const Foam::polyBoundaryMesh& patches = mesh->boundaryMesh();
    for (Foam::label i = 0; i < patches.size(); ++i) {
      const Foam::polyPatch& patch = patches[i];
      if (!Foam::isA<Foam::processorPolyPatch>(patch) || Foam::isA<Foam::processorCyclicPolyPatch>(patch)) continue;
      for (Foam::label k = 0; k < patch.size(); ++k) {
        const auto face = static_cast<std::size_t>(patch.start() + k);
        if (addressing[face] < 0) {
          face_sign[face] = -1;
          counts_face[face] = false;
        }
      }
    }
  }

  std::optional<PlainPath> plain_folder;
  std::vector<std::string> words;  ///< argList keeps pointers to them
  std::vector<char*> word_pointers;
  int foam_argc = 0;
  char** foam_argv = nullptr;
  std::unique_ptr<Foam::argList> arguments;
  std::unique_ptr<Foam::Time> time;
  std::unique_ptr<Foam::fvMesh> mesh;
  int rank = 0;
  int ranks = 1;
  std::size_t all_cells = 0;
  std::size_t all_faces = 0;
  std::vector<std::int64_t> global_cell;
  std::vector<std::int64_t> global_face;
  std::vector<int> face_sign;
  std::vector<bool> counts_face;  ///< false on the second of the two ranks that share a face
};

FoamCase::FoamCase(const std::filesystem::path& foam_folder, int& argc, char**& argv)
    : state_(std::make_unique<State>(std::filesystem::absolute(foam_folder), argc, argv)) {}
FoamCase::~FoamCase() = default;

Foam::fvMesh& FoamCase::mesh() { return *state_->mesh; }
const Foam::fvMesh& FoamCase::mesh() const { return *state_->mesh; }
int FoamCase::rank() const { return state_->rank; }
int FoamCase::ranks() const { return state_->ranks; }
const std::vector<std::int64_t>& FoamCase::global_cell() const { return state_->global_cell; }
const std::vector<std::int64_t>& FoamCase::global_face() const { return state_->global_face; }
const std::vector<int>& FoamCase::face_sign() const { return state_->face_sign; }

std::vector<double> FoamCase::local(const std::vector<double>& all_cells) const {
  std::vector<double> part(state_->global_cell.size());
  for (std::size_t i = 0; i < part.size(); ++i) part[i] = all_cells[static_cast<std::size_t>(state_->global_cell[i])];
  return part;
}

std::vector<double> FoamCase::everywhere(const std::vector<double>& local_cells, std::size_t columns) const {
  std::vector<double> all(state_->all_cells * columns, 0.0);
  for (std::size_t i = 0; i < state_->global_cell.size(); ++i) {
    for (std::size_t k = 0; k < columns; ++k) {
      all[static_cast<std::size_t>(state_->global_cell[i]) * columns + k] = local_cells[i * columns + k];
    }
  }
  if (state_->ranks > 1) {
    MPI_Allreduce(MPI_IN_PLACE, all.data(), static_cast<int>(all.size()), MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
  }
  return all;
}

std::vector<double> FoamCase::local_fluxes(const std::vector<double>& all_faces) const {
  std::vector<double> part(state_->global_face.size());
  for (std::size_t i = 0; i < part.size(); ++i) {
    part[i] = state_->face_sign[i] * all_faces[static_cast<std::size_t>(state_->global_face[i])];
  }
  return part;
}

std::vector<double> FoamCase::fluxes_everywhere(const std::vector<double>& local_faces) const {
  std::vector<double> all(state_->all_faces, 0.0);
  for (std::size_t i = 0; i < local_faces.size(); ++i) {
    if (!state_->counts_face[i]) continue;
    all[static_cast<std::size_t>(state_->global_face[i])] = state_->face_sign[i] * local_faces[i];
  }
  if (state_->ranks > 1) {
    MPI_Allreduce(MPI_IN_PLACE, all.data(), static_cast<int>(all.size()), MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
  }
  return all;
}

}  // namespace cupola
