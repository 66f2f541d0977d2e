#pragma once
#include "avi/autodiff/operation.hpp"
#include "avi/core/vector.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <vector>

/// @file
/// Program: a recorded formula, compiled for repeated evaluation with any scalar.

namespace avi {

namespace detail {
class Schedule;
class StraightLine;
}  // namespace detail

/// A list of operations without branches that computes f(x) and chosen derivatives of f; made by Recording.
/// One program works for every scalar: double, Pack<w>, Partials of these. Operations of one kind are
/// grouped, so that the kind is looked up once for each group. The slot of a result is reused once nothing
/// needs it any more. An evaluation allocates no memory.
class Program {
 public:
  /// The working memory of a program for scalar S: arguments, intermediate results and results, one number
  /// per slot.
  template <class S>
  class Room {
   public:
    /// Memory for this program.
    explicit Room(const Program& program) : slots_(program.slots_, S(0.0)) {
      for (std::size_t i = 0; i < program.numbers_.size(); ++i)
        slots_[program.inputs_ + i] = S(program.numbers_[i]);
    }
    /// The inputs() entries of x, to be set before run().
    [[nodiscard]] S* arguments() { return slots_.data(); }

   private:
    friend class Program;
    // Eigen's allocator aligns numbers of several lanes as their registers are, which makes them fastest to
    // read.
    std::vector<S, Eigen::aligned_allocator<S>> slots_;
  };

  [[nodiscard]] int inputs() const { return inputs_; }  ///< Entries of x.
  /// Number of derivatives computed.
  [[nodiscard]] int slopes() const { return static_cast<int>(slopes_.size()); }
  [[nodiscard]] std::size_t slots() const { return slots_; }  ///< Number of slots of a Room.
  /// Number of operations of one run; a product and its addition in a long sum count as one.
  [[nodiscard]] std::size_t operations() const { return operations_; }

  /// Computes the results for the arguments in the room, which keep their values. @param room made for this
  /// program
  template <class S>
  [[gnu::flatten, gnu::noinline]] void run(Room<S>& room) const {
    static_assert(sizeof(S) % 8 == 0, "A scalar is one or several numbers of eight bytes.");
    S* const slots = room.slots_.data();
    const Instruction* next = instructions_.data();
    for (const Group& group : groups_) {
      const Instruction* const end = next + group.count;
      if (group.first == Operation::sum_of_products)
        sum_products(slots, next, end);
      else
        detail::with_operation(
            group.first, [&]<Operation first>() __attribute__((always_inline)) {
              using enum Operation;
              if constexpr (detail::pairs(first))
                detail::with_one_of<add, subtract, subtract_from, multiply, nothing>(
                    group.second, [&]<Operation second>() __attribute__((always_inline)) {
                      compute<first, second>(slots, next, end);
                    });
              else if constexpr (by_number<S> && !std::is_void_v<decltype(detail::one_by_one<first>())>)
                compute_each(detail::one_by_one<first>(), slots, next, end);
              else
                compute<first, nothing>(slots, next, end);
            });
      next = end;
    }
  }
  /// f(x) of the last run, if the program computes it.
  template <class S>
  [[nodiscard]] const S& value(const Room<S>& room) const {
    return at(room.slots_.data(), value_);
  }
  /// Derivative i, 0 <= i < slopes(), of the last run.
  template <class S>
  [[nodiscard]] const S& slope(const Room<S>& room, int i) const {
    return at(room.slots_.data(), slopes_[i]);
  }

 private:
  friend class detail::Schedule;
  friend class detail::StraightLine;

  /// A slot number times eight: the byte offset for doubles. An addressing mode of the processor scales it
  /// for scalars of up to eight numbers.
  using Place = std::uint32_t;
  struct Instruction {
    // to = (a first b) second c; for a sum of products, a is its first product and b their number
    Place to, a, b, c;
  };
  struct Group {
    Operation first, second;
    std::uint32_t count;
  };
  struct Product {
    Place a, b;
  };

  template <class S>
  static S& at(S* slots, Place place) {
    using Byte = std::conditional_t<std::is_const_v<S>, const char, char>;
    return *reinterpret_cast<S*>(reinterpret_cast<Byte*>(slots) + std::size_t{place} * (sizeof(S) / 8));
  }

  /// True for a double or a pack of doubles.
  template <class S>
  static constexpr bool by_number = std::is_same_v<S, double> || requires {
    S::lanes;
  };

  // Compiled once, and shared by all functions of <cmath>.
  template <class S>
  [[gnu::noinline]] static void compute_each(double (*f)(double), S* slots, const Instruction* i,
                                             const Instruction* end) {
    for (; i != end; ++i)
      if constexpr (std::is_same_v<S, double>)
        at(slots, i->to) = f(at(slots, i->a));
      else
        at(slots, i->to) = at(slots, i->a).each(f);
  }
  template <class S>
  [[gnu::noinline]] static void compute_each(double (*f)(double, double), S* slots, const Instruction* i,
                                             const Instruction* end) {
    for (; i != end; ++i)
      if constexpr (std::is_same_v<S, double>)
        at(slots, i->to) = f(at(slots, i->a), at(slots, i->b));
      else
        at(slots, i->to) = S::each(f, at(slots, i->a), at(slots, i->b));
  }
  template <Operation first, Operation second, class S>
  static void compute(S* slots, const Instruction* i, const Instruction* end) {
    for (; i != end; ++i)
      at(slots, i->to) =
          detail::apply<second>(detail::apply<first>(at(slots, i->a), at(slots, i->b)), at(slots, i->c));
  }
  template <class S>
  void sum_products(S* slots, const Instruction* i, const Instruction* end) const {
    for (; i != end; ++i) {
      const Product* product = products_.data() + i->a;
      const Product* const last = product + i->b;
      S sum = at(slots, product->a) * at(slots, product->b);
      while (++product != last)
        sum = sum + at(slots, product->a) * at(slots, product->b);
      at(slots, i->to) = sum;
    }
  }

  int inputs_ = 0;
  std::size_t slots_ = 0, operations_ = 0;
  std::vector<double> numbers_;  // constants, stored in the slots after the inputs
  std::vector<Instruction> instructions_;
  std::vector<Group> groups_;
  std::vector<Product> products_;
  Place value_ = 0;
  std::vector<Place> slopes_;
};

namespace detail {
/// A recorded formula of (q, p) with the memory to evaluate it at all stages.
template <class Scalar>
struct RecordedFormula {
  Program program;                      ///< The program of the formula.
  Program::Room<Scalar> room{program};  ///< Its working memory.

  ///@{

  /// Evaluates the formula at (q, p).
  void run(const Scalar* q, const Scalar* p, Eigen::Index n) {
    std::copy_n(p, n, std::copy_n(q, n, room.arguments()));
    program.run(room);
  }
  template <class Vec>
  void run(const Vec& q, const Vec& p) {
    run(q.data(), p.data(), q.size());
  }
  ///@}
  [[nodiscard]] const Scalar& value() const { return program.value(room); }  ///< Value at the last point.
  [[nodiscard]] const Scalar& partial(int i) const {
    return program.slope(room, i);
  }  ///< Derivative by argument i there.
};
}  // namespace detail

}  // namespace avi
