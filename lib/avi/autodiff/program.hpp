#pragma once
#include "avi/autodiff/operation.hpp"
#include "avi/core/vector.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <vector>

/// @file
/// A recorded formula, ready to be evaluated at any scalar.

namespace avi {

namespace detail {
class Schedule;
class StraightLine;
}  // namespace detail

/// A straight line of operations that computes f(x) and chosen derivatives of f; made by Recording. One
/// program serves every scalar: double, Pack<w>, Partials of them. Operations of one kind are grouped, so
/// that the dispatch is made once for each group; the slots of results are reused as soon as nothing needs
/// them. An evaluation allocates nothing.
class Program {
 public:
  /// Arguments, intermediate results and results of a program at scalar S: one number for each slot.
  template <class S>
  class Room {
   public:
    /// For `program`.
    explicit Room(const Program& program) : slots_(program.slots_, S(0.0)) {
      for (std::size_t i = 0; i < program.numbers_.size(); ++i)
        slots_[program.inputs_ + i] = S(program.numbers_[i]);
    }
    [[nodiscard]] S* arguments() { return slots_.data(); }  ///< x, inputs() entries, read by run().

   private:
    friend class Program;
    // A number of many lanes is read fastest from where the machine would align it.
    std::vector<S, Eigen::aligned_allocator<S>> slots_;
  };

  [[nodiscard]] int inputs() const { return inputs_; }  ///< Entries of x.
  /// Number of derivatives that are computed.
  [[nodiscard]] int slopes() const { return static_cast<int>(slopes_.size()); }
  [[nodiscard]] std::size_t slots() const { return slots_; }  ///< Numbers in a Room.
  /// Operations of one run; a product and its addition in a long sum are one.
  [[nodiscard]] std::size_t operations() const { return operations_; }

  /// Computes the results at room.arguments(), which stay as they are. @param room made for this program
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
  /// f(x) of the last run, where the program computes it.
  template <class S>
  [[nodiscard]] const S& value(const Room<S>& room) const {
    return at(room.slots_.data(), value_);
  }
  /// Derivative i = 0, 1, ... slopes() - 1 of the last run.
  template <class S>
  [[nodiscard]] const S& slope(const Room<S>& room, int i) const {
    return at(room.slots_.data(), slopes_[i]);
  }

 private:
  friend class detail::Schedule;
  friend class detail::StraightLine;

  /// Eight times the number of a slot, so that an addressing mode of the processor finds slots of up to eight
  /// numbers.
  using Place = std::uint32_t;
  struct Instruction {
    Place to, a, b, c;  // (a first b) second c; of a sum of products: a is its first one, b their number
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

  /// It is a double, or a pack of them.
  template <class S>
  static constexpr bool by_number = std::is_same_v<S, double> || requires {
    S::lanes;
  };

  // Compiled once for all functions of the standard library.
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
  std::vector<double> numbers_;  // in the slots behind the inputs
  std::vector<Instruction> instructions_;
  std::vector<Group> groups_;
  std::vector<Product> products_;
  Place value_ = 0;
  std::vector<Place> slopes_;
};

namespace detail {
/// A recorded formula of (q, p) and the memory to evaluate it at the stages.
template <class Scalar>
struct RecordedFormula {
  Program program;                      ///< The formula.
  Program::Room<Scalar> room{program};  ///< Its numbers.

  ///@{

  /// Evaluates it.
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
  }  ///< Slope by argument i there.
};
}  // namespace detail

}  // namespace avi
