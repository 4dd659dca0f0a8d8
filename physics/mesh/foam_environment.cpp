// libOpenFOAM reads <WM_PROJECT_DIR>/etc/controlDict while its static objects are made, before main.  Where the
// variable is missing, the program starts itself anew with it: functions in .preinit_array of an executable run before
// the initialisers of its shared libraries, and execve keeps the process id, so that mpirun does not notice.
#include <unistd.h>

#include <cstdlib>
#include <cstring>

namespace {

constexpr char variable[] = "WM_PROJECT_DIR=/usr/share/openfoam";

void provide_project_folder(int /*argument_count*/, char** arguments, char** environment) {
  const std::size_t name_length = std::strlen("WM_PROJECT_DIR=");
  std::size_t count = 0;
  for (; environment[count] != nullptr; ++count) {
    if (std::strncmp(environment[count], variable, name_length) == 0) return;
  }
  // No constructor has run yet: plain C only.
  auto** extended = static_cast<char**>(std::calloc(count + 2, sizeof(char*)));
  if (extended == nullptr) return;
  std::memcpy(extended, environment, count * sizeof(char*));
  extended[count] = const_cast<char*>(variable);
  execve("/proc/self/exe", arguments, extended);
  // Reached only where execve fails; OpenFOAM then says itself what it misses.
  std::free(extended);
}

}  // namespace

__attribute__((section(".preinit_array"),
               used)) static void (*const provide_project_folder_first)(int, char**, char**) = &provide_project_folder;
