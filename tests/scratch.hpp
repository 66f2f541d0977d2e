#pragma once
#include <cstdlib>
#include <filesystem>
#include <stdexcept>
#include <string>

/// A folder of its own for the files of a test, which is removed with all of them at the end.
class Scratch : public std::filesystem::path {
 public:
  Scratch() : path(made()) {}
  Scratch(const Scratch&) = delete;
  ~Scratch() { std::filesystem::remove_all(*this); }

 private:
  static std::string made() {
    const std::string unique(6, 'X');  // mkdtemp() writes letters of its own over these
    std::string name = std::filesystem::temp_directory_path() / ("avi_test_" + unique);
    if (!::mkdtemp(name.data())) throw std::runtime_error("Cannot make the folder " + name + ".");
    return name;
  }
};
