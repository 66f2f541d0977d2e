#include "src/delivery/checkpoint.hpp"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <stdexcept>

namespace avi::detail {

namespace {

constexpr std::uint64_t magic = 0x3574696272'6f6976ull;  // "viorbit5": the last digit is the version

[[noreturn]] void damaged(const std::string& why) {
  throw std::invalid_argument("The checkpoint " + why + ".");
}

void put_graph(Record& record, const ExpressionGraph& graph, int node) {
  record.put(graph.inputs());
  for (int i = 0; i <= node; ++i) {
    record.put(static_cast<int>(graph[i].operation));
    record.put(graph[i].a);
    record.put(graph[i].b);
    record.put(graph[i].number);
  }
}

}  // namespace

std::uint64_t Record::sum() const {
  std::uint64_t hash = 14695981039346656037ull;  // Fowler, Noll and Vo
  for (const std::uint64_t word : words_)
    for (int shift = 0; shift < 64; shift += 8)
      hash = (hash ^ ((word >> shift) & 255)) * 1099511628211ull;
  return hash;
}

std::uint64_t Record::next() {
  if (read_ == words_.size()) damaged("ends too early");
  return words_[read_++];
}

std::size_t Record::size() {
  const std::uint64_t count = next();
  if (count > words_.size()) damaged("has a list longer than itself");
  return static_cast<std::size_t>(count);
}

Record::Record(const std::string& file) {
  require_regular(file);
  std::error_code unknown;  // reading the file will report it
  if (std::filesystem::status(file, unknown).type() == std::filesystem::file_type::not_found)
    throw std::invalid_argument("There is no checkpoint " + file + ".");
  std::ifstream in(file, std::ios::binary);
  if (!in) damaged(file + " cannot be read");
  std::uint64_t head[3];
  const auto read = [&](std::uint64_t* words, std::size_t count) {
    in.read(reinterpret_cast<char*>(words), static_cast<std::streamsize>(8 * count));
    return static_cast<bool>(in);
  };
  if (!read(head, 3) || head[0] != magic) damaged(file + " is none, or of another version");
  std::error_code error;
  const std::uintmax_t bytes = std::filesystem::file_size(file, error);
  if (error || bytes % 8 != 0 || bytes / 8 < 3 || head[1] != bytes / 8 - 3) damaged(file + " is not whole");
  words_.resize(static_cast<std::size_t>(head[1]));
  if (!read(words_.data(), words_.size()) || sum() != head[2]) damaged(file + " is damaged");
}

void Record::write(const std::string& file) const {
  require_regular(file);
  const std::string beside = file + ".part";
  const std::uint64_t head[3] = {magic, words_.size(), sum()};
  std::ofstream out(beside, std::ios::binary | std::ios::trunc);
  out.write(reinterpret_cast<const char*>(head), sizeof head);
  out.write(reinterpret_cast<const char*>(words_.data()), static_cast<std::streamsize>(8 * words_.size()));
  out.close();
  std::error_code error;
  if (out) std::filesystem::rename(beside, file, error);
  if (!out || error) {
    std::remove(beside.c_str());
    throw std::runtime_error("The checkpoint " + file + " cannot be written.");
  }
}

void require_regular(const std::string& file) {
  std::error_code error;
  const auto status = std::filesystem::status(file, error);
  if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status))
    throw std::invalid_argument("The checkpoint " + file + " must be a file; it is a device or a folder.");
}

bool is_kept(const std::string& file) {
  std::error_code unreadable;  // writing the file will report it
  if (file.empty() || !std::filesystem::is_regular_file(file, unreadable)) return false;
  std::ifstream in(file, std::ios::binary);
  std::uint64_t head = 0;
  const bool whole = static_cast<bool>(in.read(reinterpret_cast<char*>(&head), sizeof(head)));
  const bool ours = whole && (head ^ magic) << 8 == 0;  // in any version, which is the highest byte
  if (!ours && in.gcount() > 0)
    throw std::invalid_argument("The file " + file +
                                " is no checkpoint, and would be replaced by one; name another file.");
  return true;
}

std::uint64_t fingerprint(const OrbitQuestion& question) {
  Record record;
  put_graph(record, question.graph, question.energy);
  record.put(question.gradient);
  if (!question.gradient.empty())
    put_graph(record, question.graph, *std::ranges::max_element(question.gradient));
  if (question.given >= 0) put_graph(record, question.graph, question.given);
  for (const OrbitEvent& event : question.events) {
    put_graph(record, event.g.graph(), event.g.node());
    record.put(event.rules.direction);
    record.put(event.rules.count);
    record.put(event.rules.stop);
  }
  return record.sum();
}

}  // namespace avi::detail
