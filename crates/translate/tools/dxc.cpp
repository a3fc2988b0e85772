// dxc: the command line of Microsoft's DirectX Shader Compiler over a library `libdxcompiler.so` whose packages bring no program.
//
//   dxc [ARGUMENTS OF DXC...] [-Fo FILE] INPUT
//   dxc --version
//
// Arguments go to the library as they are, except -Fo and INPUT, which are read here. An object in DXIL is given to the library's
// validator as well, and counts only if that accepts it. Exit codes: 0 fine, 1 the compiler or the validator refuses, 3 the
// library or a file is missing. The library lies in `../lib` beside this program, or where BOSSAGE_DXCOMPILER says.
//
// Limits: one input, UTF-8, no include files.
#include "WinAdapter.h"
#include "dxcapi.h"

#include <clocale>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <dlfcn.h>
#include <fstream>
#include <sstream>
#include <string>
#include <unistd.h>
#include <vector>

namespace {

enum Exit { fine = 0, refused = 1, missing = 3 };

// Without the destructors of the library's globals: they touch what is gone by then.
[[noreturn]] void leave(Exit code) {
  std::fflush(stdout);
  std::fflush(stderr);
  _exit(code);
}

[[noreturn]] void fail(Exit code, const std::string &what) {
  std::fprintf(stderr, "dxc: %s\n", what.c_str());
  leave(code);
}

std::string library_path() {
  if (const char *given = std::getenv("BOSSAGE_DXCOMPILER")) return given;
  char self[4096];
  const ssize_t length = readlink("/proc/self/exe", self, sizeof self - 1);
  if (length < 0) return "libdxcompiler.so";
  const std::string path(self, static_cast<size_t>(length));
  return path.substr(0, path.rfind('/')) + "/../lib/libdxcompiler.so";
}

template <class Interface> Interface *create(DxcCreateInstanceProc make, REFCLSID type, const char *name) {
  Interface *made = nullptr;
  if (FAILED(make(type, __uuidof(Interface), reinterpret_cast<void **>(&made))) || made == nullptr)
    fail(missing, std::string("the library offers no ") + name);
  return made;
}

void print_version(IDxcCompiler3 *compiler) {
  IDxcVersionInfo *numbers = nullptr;
  compiler->QueryInterface(__uuidof(IDxcVersionInfo), reinterpret_cast<void **>(&numbers));
  if (numbers == nullptr) fail(missing, "the library does not say its version");
  UINT32 major = 0, minor = 0;
  numbers->GetVersion(&major, &minor);
  IDxcVersionInfo2 *commits = nullptr;
  compiler->QueryInterface(__uuidof(IDxcVersionInfo2), reinterpret_cast<void **>(&commits));
  UINT32 count = 0;
  char *hash = nullptr;
  if (commits != nullptr) commits->GetCommitInfo(&count, &hash);
  std::printf("libdxcompiler.so: %u.%u (%u, %s)\n", major, minor, count, hash ? hash : "unknown commit");
}

std::string read_file(const std::string &path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) fail(missing, "`" + path + "` can't be read");
  std::stringstream text;
  text << file.rdbuf();
  return text.str();
}

std::wstring wide(const std::string &narrow) { return std::wstring(narrow.begin(), narrow.end()); }

// The validator's verdict on a container; true for what holds no DXIL.
bool is_valid(DxcCreateInstanceProc make, IDxcBlob *object) {
  if (object->GetBufferSize() < 4 || std::memcmp(object->GetBufferPointer(), "DXBC", 4) != 0) return true;
  auto *validator = create<IDxcValidator>(make, CLSID_DxcValidator, "validator");
  IDxcOperationResult *verdict = nullptr;
  HRESULT status = E_FAIL;
  if (SUCCEEDED(validator->Validate(object, DxcValidatorFlags_Default, &verdict)) && verdict != nullptr)
    verdict->GetStatus(&status);
  IDxcBlobEncoding *errors = nullptr;
  if (FAILED(status) && verdict != nullptr) verdict->GetErrorBuffer(&errors);
  if (errors != nullptr)
    std::fprintf(stderr, "%.*s\n", static_cast<int>(errors->GetBufferSize()),
                 static_cast<const char *>(errors->GetBufferPointer()));
  return SUCCEEDED(status);
}

struct Call {
  std::vector<std::wstring> arguments;
  std::string input, output;
};

Call read_call(int count, char **given) {
  // Options whose value is an argument of its own.
  const std::vector<std::string> paired = {"-T", "-E", "-D", "-HV", "-Fc", "-Fd", "-I"};
  Call call;
  for (int at = 1; at < count; at++) {
    const std::string argument = given[at];
    if (argument == "-Fo" && at + 1 < count) {
      call.output = given[++at];
    } else if (argument[0] == '-') {
      call.arguments.push_back(wide(argument));
      size_t values = 0;
      for (const auto &name : paired) values += argument == name;
      if (argument == "-fvk-bind-register") values = 4;
      for (; values > 0 && at + 1 < count; values--) call.arguments.push_back(wide(given[++at]));
    } else {
      call.input = argument;
    }
  }
  if (call.input.empty()) fail(missing, "no input file is given");
  return call;
}

Exit compile(DxcCreateInstanceProc make, IDxcCompiler3 *compiler, const Call &call) {
  const std::string text = read_file(call.input);
  const std::wstring name = wide(call.input);
  std::vector<LPCWSTR> arguments = {name.c_str()};
  for (const auto &argument : call.arguments) arguments.push_back(argument.c_str());
  const DxcBuffer buffer{text.data(), text.size(), DXC_CP_UTF8};
  IDxcResult *result = nullptr;
  compiler->Compile(&buffer, arguments.data(), static_cast<UINT32>(arguments.size()), nullptr, __uuidof(IDxcResult),
                    reinterpret_cast<void **>(&result));
  if (result == nullptr) fail(refused, "the compiler gives no result");
  IDxcBlobUtf8 *said = nullptr;
  result->GetOutput(DXC_OUT_ERRORS, __uuidof(IDxcBlobUtf8), reinterpret_cast<void **>(&said), nullptr);
  if (said != nullptr && said->GetStringLength() > 0) std::fprintf(stderr, "%s\n", said->GetStringPointer());
  HRESULT status = E_FAIL;
  result->GetStatus(&status);
  if (FAILED(status)) return refused;
  IDxcBlob *object = nullptr;
  result->GetOutput(DXC_OUT_OBJECT, __uuidof(IDxcBlob), reinterpret_cast<void **>(&object), nullptr);
  if (object == nullptr || object->GetBufferSize() == 0) fail(refused, "the compiler gives an empty object");
  if (!is_valid(make, object)) return refused;
  if (call.output.empty()) return fine;
  std::ofstream file(call.output, std::ios::binary);
  file.write(static_cast<const char *>(object->GetBufferPointer()), static_cast<std::streamsize>(object->GetBufferSize()));
  file.close();
  if (!file) fail(missing, "`" + call.output + "` can't be written");
  return fine;
}

} // namespace

int main(int count, char **arguments) {
  std::setlocale(LC_ALL, "C.UTF-8");
  const std::string path = library_path();
  void *library = dlopen(path.c_str(), RTLD_NOW);
  if (library == nullptr) fail(missing, dlerror());
  const auto make = reinterpret_cast<DxcCreateInstanceProc>(dlsym(library, "DxcCreateInstance"));
  if (make == nullptr) fail(missing, "`" + path + "` is no DXC library");
  auto *compiler = create<IDxcCompiler3>(make, CLSID_DxcCompiler, "compiler");
  if (count == 2 && std::strcmp(arguments[1], "--version") == 0) {
    print_version(compiler);
    leave(fine);
  }
  leave(compile(make, compiler, read_call(count, arguments)));
}
