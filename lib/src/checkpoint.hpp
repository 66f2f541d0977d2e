#pragma once
#include "avi/solve.hpp"

#include <bit>
#include <concepts>
#include <cstdint>
#include <string>
#include <vector>

/// @file
/// A run as a file, from which it can go on.

namespace avi::detail {

/// Numbers and words in the order in which they are written and read.
class Record {
 public:
  /// Nothing yet.
  Record() = default;
  /// The content of a file. @throws std::invalid_argument for one that is none of ours, of another version,
  /// or damaged.
  explicit Record(const std::string& file);
  /// Writes it into a file beside that one, which then takes its name: the file is there whole or as before.
  /// @throws std::runtime_error where it cannot be written.
  void write(const std::string& file) const;

  ///@{

  /// Adds.
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

  /// Reads what comes next.
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

  /// A number that tells this record from others.
  [[nodiscard]] std::uint64_t sum() const;

 private:
  std::uint64_t next();
  std::size_t size();
  std::vector<std::uint64_t> words_;
  std::size_t read_ = 0;
};

/// Refuses a device or a folder, which a file would replace. @throws std::invalid_argument
void require_regular(const std::string& file);

/// Whether there is a file of an earlier call. @throws std::invalid_argument for one that is no checkpoint
bool is_kept(const std::string& file);

/// Tells the H, the events and the given monitor of a question from others.
std::uint64_t fingerprint(const OrbitQuestion& question);

}  // namespace avi::detail
