#pragma once
#include "avi/solve.hpp"

#include <bit>
#include <concepts>
#include <cstdint>
#include <string>
#include <vector>

/// @file
/// A file that keeps a run, so that it can be resumed.

namespace avi::detail {

/// A list of numbers and texts, read in the order in which they were written.
class Record {
 public:
  /// Makes an empty record.
  Record() = default;
  /// Reads the content of a file. @throws std::invalid_argument if it is no checkpoint, one of another
  /// version, or damaged
  explicit Record(const std::string& file);
  /// Writes the record into a file beside that one, which then takes its name: so the file is either complete
  /// or as it was before. @throws std::runtime_error where it cannot be written
  void write(const std::string& file) const;

  ///@{

  /// Adds a value.
  void put(double number) { words_.push_back(std::bit_cast<std::uint64_t>(number)); }
  template <std::integral Number>
  void put(Number number) {
    words_.push_back(static_cast<std::uint64_t>(number));
  }
  void put(const std::string& text) { put(std::vector<char>(text.begin(), text.end())); }
  template <class T>
  void put(const std::vector<T>& list) {
    put(list, list.size());
  }
  template <class T>
  void put(const std::vector<T>& list, std::size_t first) {
    put(first);
    for (std::size_t i = 0; i < first; ++i)
      put(list[i]);
  }
  ///@}
  ///@{

  /// Reads the next value.
  void get(double& number) { number = std::bit_cast<double>(next()); }
  template <std::integral Number>
  void get(Number& number) {
    number = static_cast<Number>(next());
  }
  void get(std::string& text) {
    std::vector<char> letters;
    get(letters);
    text.assign(letters.begin(), letters.end());
  }
  template <class T>
  void get(std::vector<T>& list) {
    list.resize(size());
    for (T& each : list)
      get(each);
  }
  ///@}

  /// Checksum of the record.
  [[nodiscard]] std::uint64_t sum() const;

 private:
  std::uint64_t next();
  std::size_t size();
  std::vector<std::uint64_t> words_;
  std::size_t read_ = 0;
};

/// Requires that a file is not a device or a folder, which a checkpoint would replace.
/// @throws std::invalid_argument
void require_regular(const std::string& file);

/// Returns true if there is a checkpoint of an earlier call. @throws std::invalid_argument for a file that is
/// no checkpoint
bool is_kept(const std::string& file);

/// A number that identifies the H, the events and the given monitor of a question.
std::uint64_t fingerprint(const OrbitQuestion& question);

}  // namespace avi::detail
