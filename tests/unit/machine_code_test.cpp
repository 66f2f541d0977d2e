#include "avi/autodiff/recording.hpp"
#include "digest.hpp"
#include "refusal.hpp"
#include "src/autodiff/code_writer.hpp"
#include "src/autodiff/machine_code.hpp"
#include "src/autodiff/pack_functions.hpp"
#include "src/autodiff/schedule.hpp"
#include "unit/random_graph.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <memory>
#include <random>
#include <string>
#include <vector>
#if defined(__x86_64__)
#include <cpuid.h>
#endif
#if defined(__linux__)
#include <sys/wait.h>
#include <unistd.h>
#endif

using avi::ExpressionGraph, avi::Operation, avi::Pack, avi::Program, avi::detail::MachineCode;

namespace machine_code_test {

bool runs(bool avx512) {
#if defined(__x86_64__)
  __builtin_cpu_init();
  return avx512 ? __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
                      __builtin_cpu_supports("avx512vl")
                : __builtin_cpu_supports("avx2") != 0;
#else
  return (void)avx512, false;
#endif
}

/// Compares all results of a program at packs with those of its machine code.
template <int w>
void compare(const Program& program, bool avx512, unsigned seed, const std::string& what, int parameters) {
  const Program* const all[] = {&program};
  const auto code = MachineCode::of(all, {.lanes = w,
                                          .avx512 = avx512,
                                          .functions = avi::detail::pack_functions<w>(),
                                          .parameters = parameters});
  ASSERT_TRUE(code);
  Program::Room<Pack<w>> room(program);
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> number(-2.0, 2.5);
  const int n = (program.inputs() - parameters) / 2;
  for (int i = 0; i < program.inputs(); ++i)
    for (int k = 0; k < w; ++k)
      room.arguments()[i].set(k, number(random));
  const Pack<w> factor(0.37);
  std::vector<Pack<w>> factors{factor};
  factors.insert(factors.end(), room.arguments() + 2 * n, room.arguments() + program.inputs());
  std::vector<Pack<w>> q(room.arguments(), room.arguments() + n),
      p(room.arguments() + n, room.arguments() + 2 * n);
  std::vector<Pack<w>> out(static_cast<std::size_t>(std::max(program.slopes(), 1)) + 1, Pack<w>(-77.0));
  const auto numbers = [](auto& x) { return reinterpret_cast<double*>(x.data()); };
  (*code)[0](numbers(q), numbers(p), numbers(factors), numbers(out));
  program.run(room);
  const int count = program.slopes();
  for (int k = 0; k < w; ++k) {
    for (int i = 0; i < count; ++i)
      ASSERT_TRUE(random_graph::alike(out[i][k], Pack<w>(factor * program.slope(room, i))[k]))
          << what << ", result " << i << ", number " << k << " of " << w;
    if (count == 0) {
      ASSERT_TRUE(random_graph::alike(out[0][k], program.value(room)[k])) << what;
    }
  }
  EXPECT_EQ(out.back()[w - 1], -77.0) << what << ": it wrote beyond its results";
}
void compare(const Program& program, unsigned seed, const std::string& what, int parameters = 0) {
  for (const bool avx512 : {false, true})
    if (runs(avx512)) {
      compare<2>(program, avx512, seed, what + (avx512 ? ", AVX-512" : ", AVX2"), parameters);
      compare<4>(program, avx512, seed, what + (avx512 ? ", AVX-512" : ", AVX2"), parameters);
      compare<8>(program, avx512, seed, what + (avx512 ? ", AVX-512" : ", AVX2"), parameters);
    }
}

TEST(MachineCode, HasTheBitsOfTheInterpreter) {
  if (!runs(false)) GTEST_SKIP() << "a processor without AVX2";
  for (unsigned seed = 0; seed < 200; ++seed) {
    std::mt19937 random(seed);
    // Every other one with calls of functions, the others without.
    std::vector<Operation> without;
    if (seed % 2)
      for (const Operation operation : random_graph::operations())
        if (avi::detail::operands(operation) > 0 && operation >= Operation::sqrt &&
            operation < Operation::sign && operation != Operation::sqrt && operation != Operation::abs)
          without.push_back(operation);
    const ExpressionGraph graph = random_graph::draw(random, 4, without);
    std::vector<int> slopes;
    for (int i = static_cast<int>(random() % 7); i > 0; --i)
      slopes.push_back(static_cast<int>(random() % static_cast<unsigned>(graph.size())));
    const int value = slopes.empty() ? graph.size() - 1 : -1;
    compare(avi::detail::Schedule::program(graph, value, slopes, graph.size()), seed,
            "seed " + std::to_string(seed), seed % 3 == 0 ? 2 : 0);
  }
}

/// The bytes of the code of 200 formulas and a digest of them; what is called has a made-up address.
std::string bytes(int lanes, bool avx512) {
  std::vector<avi::detail::PackFunction> functions;
  for (std::uintptr_t i = 0; i < static_cast<std::uintptr_t>(Operation::sum_of_products); ++i)
    functions.push_back(reinterpret_cast<avi::detail::PackFunction>(0x10000 + 16 * i));
  Digest all;
  std::size_t count = 0;
  for (unsigned seed = 0; seed < 200; ++seed) {
    std::mt19937 random(seed);
    const ExpressionGraph graph = random_graph::draw(random, 4);
    std::vector<int> slopes;
    for (int i = 0; i < static_cast<int>(seed % 7); ++i)
      slopes.push_back(graph.size() - 1 - 3 * i % graph.size());
    const Program program =
        avi::detail::Schedule::program(graph, slopes.empty() ? graph.size() - 1 : -1, slopes, graph.size());
    const avi::detail::StraightLine line(program);
    avi::detail::Assembler assembler(std::min(lanes, avx512 ? 8 : 4));
    std::vector<double> pool{1.0, 0.0, -0.0, 1.0};
    avi::detail::CodeWriter writer(line, {.lanes = lanes, .avx512 = avx512, .functions = functions.data()},
                                   pool, assembler);
    writer.write();
    count += assembler.code.size();
    all.add(assembler.code.data(), assembler.code.size());
  }
  return std::to_string(count) + " " + all.text();
}

// Which register holds what is nothing that results depend on: a change of it has to be meant.
TEST(MachineCode, IsTheCodeThatItWas) {
  EXPECT_EQ(bytes(2, false), "1029254 719a1771");
  EXPECT_EQ(bytes(2, true), "1015402 97f69fda");
  EXPECT_EQ(bytes(4, false), "1038206 3e5b43ab");
  EXPECT_EQ(bytes(8, false), "2033321 bed10cbe");
  EXPECT_EQ(bytes(4, true), "1022536 0acc9a38");
  EXPECT_EQ(bytes(8, true), "963227 f5ee57e2");
}

TEST(MachineCode, KnowsEveryOperation) {
  if (!runs(false)) GTEST_SKIP() << "a processor without AVX2";
  for (const Operation operation : random_graph::operations())
    for (const double exponent : {-8.0, -2.5, -1.75, -1.5, -1.25, -0.75, -0.25, 0.25, 0.75, 1.5, 3.0, 1.1}) {
      ExpressionGraph graph(2);
      const int node = operation == Operation::power           ? graph.power(0, exponent)
                       : avi::detail::operands(operation) == 1 ? graph.unary(operation, 0)
                                                               : graph.binary(operation, 0, 1);
      compare(avi::detail::Schedule::program(graph, node, {}, graph.size()), 1, avi::detail::name(operation));
      if (operation != Operation::power) break;
    }
}

// Arguments and numbers as results, one of them twice.
TEST(MachineCode, PassesOnWhatNeedsNoOperation) {
  if (!runs(false)) GTEST_SKIP() << "a processor without AVX2";
  ExpressionGraph graph(4);
  const int seven = graph.constant(7.0);
  compare(avi::detail::Schedule::program(graph, -1, {3, seven, 0, 3}, graph.size()), 5, "arguments");
  compare(avi::detail::Schedule::program(graph, seven, {}, graph.size()), 5, "a number");
}

/// The upper parts of vector registers are in use, as far as the processor tells.
bool upper_parts_in_use() {
#if defined(__x86_64__)
  unsigned low = 0, high = 0;
  __asm__ volatile("xgetbv" : "=a"(low), "=d"(high) : "c"(1));
  return (low & 4) != 0;
#else
  return false;
#endif
}
bool tells_what_is_in_use() {
#if defined(__x86_64__)
  unsigned a = 0, b = 0, c = 0, d = 0;
  return runs(false) && __get_cpuid_count(0xd, 1, &a, &b, &c, &d) && (a & 4) != 0;
#else
  return false;
#endif
}

// Beside them, instructions of the standard library that know only the lower parts take thirty times as long.
TEST(MachineCode, ClearsRegistersBeforeACall) {
  if (!tells_what_is_in_use()) GTEST_SKIP() << "the processor does not tell";
  static bool in_use;
  in_use = false;
  std::vector<avi::detail::PackFunction> functions(
      static_cast<std::size_t>(Operation::sum_of_products),
      [](double*, const double*) { in_use = in_use || upper_parts_in_use(); });
  ExpressionGraph graph(2);
  const int square = graph.binary(Operation::multiply, 0, 0),
            node = graph.binary(Operation::hypot, square, 1);
  const Program program = avi::detail::Schedule::program(graph, node, {}, graph.size());
  const Program* const all[] = {&program};
  for (const bool avx512 : {false, true}) {
    if (!runs(avx512)) continue;
    const auto code = MachineCode::of(all, {.lanes = 8, .avx512 = avx512, .functions = functions.data()});
    ASSERT_TRUE(code);
    Pack<8> q(3.0), p(4.0), factor(1.0), out(0.0);
    const auto number = [](Pack<8>& x) { return reinterpret_cast<double*>(&x); };
    (*code)[0](number(q), number(p), number(factor), number(out));
    EXPECT_FALSE(in_use) << avx512;
  }
}

// The gradient of a long chain of products needs all of them.
TEST(MachineCode, IsNotMadeWhereItWouldTakeTheWholeStack) {
  const auto made = [](int length) {
    const auto chain = [=](const auto& x) {
      auto y = x[0];
      for (int k = 0; k < length; ++k)
        y = y * (1.0 - 1e-7 * y * x[1]);
      return y;
    };
    const Program program = avi::Recording(chain, 2).gradient();
    const Program* const all[] = {&program};
    return MachineCode::of(
               all, {.lanes = 4, .avx512 = false, .functions = avi::detail::pack_functions<4>()}) != nullptr;
  };
  EXPECT_EQ(made(1000), made(1));
  EXPECT_FALSE(made(100'000));
}

TEST(MachineCode, IsSwitchedOffByTheEnvironment) {
  ExpressionGraph graph(2);
  const Program program = avi::detail::Schedule::program(graph, 1, {}, graph.size());
  const Program* const all[] = {&program};
  const auto make = [&] {
    return MachineCode::of(all, {.lanes = 4, .avx512 = false, .functions = avi::detail::pack_functions<4>()});
  };
  setenv("AVI_MACHINE_CODE", "off", 1);
  EXPECT_FALSE(make());
  setenv("AVI_MACHINE_CODE", "of", 1);
  EXPECT_EQ(refusal([&] { (void)make(); }), "AVI_MACHINE_CODE is of; it must be on or off.");
  unsetenv("AVI_MACHINE_CODE");
#if defined(__linux__) && defined(__x86_64__)
  EXPECT_TRUE(make());
#endif
}

#if defined(__linux__)
/// Code of q plus a number, at packs of two.
std::unique_ptr<const MachineCode> plus(double number) {
  ExpressionGraph graph(2);
  const int sum = graph.binary(Operation::add, 0, graph.constant(number));
  const Program program = avi::detail::Schedule::program(graph, sum, {}, graph.size());
  const Program* const all[] = {&program};
  return MachineCode::of(all, {.lanes = 2, .avx512 = false, .functions = avi::detail::pack_functions<2>()});
}
double at_one(const MachineCode& code) {
  const double q[2]{1.0, 1.0}, p[2]{}, factor[2]{1.0, 1.0};
  double out[4]{};
  code[0](q, p, factor, out);
  return out[0];
}

// A process shares the pages of code with its forks, which may still run what it has given back.
TEST(MachineCode, OfAForkStaysAsItIs) {
  if (!runs(false)) GTEST_SKIP() << "a processor without AVX2";
  auto code = plus(2.0);
  (void)plus(1.0);  // given back: its pages would be taken for the next one, but not after a fork
  int replaced[2];
  ASSERT_EQ(pipe(replaced), 0);
  const pid_t child = fork();
  ASSERT_GE(child, 0);
  if (child == 0) {
    close(replaced[1]);
    char any = 0;
    const bool told = read(replaced[0], &any, 1) == 1, own = at_one(*plus(5.0)) == 6.0;
    _exit(told && own && at_one(*code) == 3.0 ? 0 : 1);
  }
  code.reset();
  code = plus(3.0);
  const auto another = plus(4.0);
  EXPECT_EQ(write(replaced[1], "x", 1), 1);
  int status = -1;
  EXPECT_EQ(waitpid(child, &status, 0), child);
  EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0) << status;
  EXPECT_EQ(at_one(*code), 4.0);
  EXPECT_EQ(at_one(*another), 5.0);
  close(replaced[0]), close(replaced[1]);
}
#endif

}  // namespace machine_code_test
