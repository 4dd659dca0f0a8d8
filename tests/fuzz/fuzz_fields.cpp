#include <sys/mman.h>
#include <unistd.h>

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <string>

#include "physics/mesh/bed_mesh.hpp"
#include "physics/mesh/cell_locator.hpp"
#include "schemas/failure.hpp"
#include "schemas/field_file.hpp"

namespace {

using cupola::Failure;

/// The input as a file, in memory.
class InputFile {
 public:
  InputFile(const std::uint8_t* data, std::size_t size) : descriptor_(::memfd_create("input", MFD_CLOEXEC)) {
    for (std::size_t done = 0; done < size;) {
      const ssize_t written = ::write(descriptor_, data + done, size - done);
      if (written <= 0) std::abort();
      done += static_cast<std::size_t>(written);
    }
  }
  ~InputFile() { ::close(descriptor_); }
  InputFile(const InputFile&) = delete;
  InputFile& operator=(const InputFile&) = delete;
  InputFile(InputFile&&) = delete;
  InputFile& operator=(InputFile&&) = delete;
  [[nodiscard]] std::filesystem::path path() const { return "/proc/self/fd/" + std::to_string(descriptor_); }

 private:
  int descriptor_;
};

/// Does it, and takes a sentence for an answer.
void allow_failure(const std::function<void()>& work) {
  try {
    work();
  } catch (const Failure& failure) {
    if (std::string(failure.what()).empty()) std::abort();
  }
}

/// Every dataset by every kind of reading.
void read_group(const cupola::HdfReader& hdf, const std::string& group) {
  for (const auto& name : hdf.names(group)) {
    const std::string path = group + "/" + name;
    allow_failure([&] { static_cast<void>(hdf.shape(path)); });
    allow_failure([&] { static_cast<void>(hdf.doubles(path)); });
    allow_failure([&] { static_cast<void>(hdf.integers(path)); });
    allow_failure([&] { static_cast<void>(hdf.bytes(path)); });
    allow_failure([&] { static_cast<void>(hdf.text(path)); });
  }
}

}  // namespace

/// Any bytes as a file of fields and as a mesh: refused with a sentence, or read, and then a mesh in which cells can be
/// found.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const InputFile file(data, size);
  allow_failure([&] {
    const cupola::FieldFile fields(file.path(), "");
    allow_failure([&] { static_cast<void>(fields.summary()); });
    allow_failure([&] { static_cast<void>(fields.points()); });
    allow_failure([&] { static_cast<void>(fields.cell_points()); });
    for (const char* group :
         {"/VTKHDF", "/VTKHDF/CellData", "/Mesh", "/Packing", "/Charging", "/Tracers", "/CohesiveZone"})
      allow_failure([&] { read_group(fields.hdf(), group); });
    for (const auto& name : fields.cell_data_names()) allow_failure([&] { static_cast<void>(fields.cell_data(name)); });
  });
  allow_failure([&] {
    const cupola::BedMesh mesh = cupola::BedMesh::read(file.path());
    const cupola::CellLocator locator(mesh);
    for (const auto& centre : mesh.cell_centre) {
      const auto cell = locator.find(centre);
      if (cell < -1 || cell >= static_cast<std::int64_t>(mesh.cells())) std::abort();
      static_cast<void>(locator.nearest(centre));
    }
  });
  return 0;
}
