#include "stage_dem/liggghts_instance.hpp"

#include <liggghts/lammps.h>
#include <liggghts/library.h>

#include <array>
#include <exception>

#include "schemas/failure.hpp"

namespace cupola {

LiggghtsInstance::LiggghtsInstance(MPI_Comm communicator, const std::string& log_file) {
  MPI_Comm_dup(communicator, &communicator_);
  MPI_Comm_rank(communicator_, &rank_);
  MPI_Comm_size(communicator_, &ranks_);
  // The screen must be a file: without one LIGGGHTS writes through a null pointer.
  std::array<std::string, 6> words{"liggghts", "-log", "none", "-screen", "/dev/null", "-nocite"};
  std::array<char*, words.size()> pointers{};
  for (std::size_t i = 0; i < words.size(); ++i) pointers[i] = words[i].data();
  void* opened = nullptr;
  lammps_open(static_cast<int>(pointers.size()), pointers.data(), communicator_, &opened);
  instance_ = static_cast<LAMMPS_NS::LAMMPS*>(opened);
  if (!log_file.empty()) command("log " + log_file + " append");
}

LiggghtsInstance::~LiggghtsInstance() {
  if (std::uncaught_exceptions() > 0 && ranks_ > 1) return;
  lammps_close(instance_);
  MPI_Comm_free(&communicator_);
}

void LiggghtsInstance::command(const std::string& line) {
  guarded(line, [&] { lammps_command(instance_, line.c_str()); });
}

void LiggghtsInstance::guarded(const std::string& line, const std::function<void()>& work) {
  try {
    work();
  } catch (Failure& failure) {
    failure.at("command", line);
    throw;
  }
}

}  // namespace cupola
