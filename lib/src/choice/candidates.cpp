#include "src/choice/candidates.hpp"

#include "avi/core/dot.hpp"
#include "avi/core/require.hpp"
#include "src/autodiff/reverse.hpp"
#include "src/autodiff/rounded_formula.hpp"
#include "src/features/poles.hpp"

#include <array>
#include <limits>
#include <numeric>

namespace avi::detail {

namespace {

/// A name in the menu and the power \f$\alpha\f$ that it stands for.
struct Entry {
  const char* name;
  double alpha;
};
constexpr Entry known_monitors[] = {{"fixed", 0.0}, {"energy", 1.0},         {"energy^1.5", 1.5},
                                    {"poles", 1.0}, {"acceleration", 0.375}, {splitting.data(), 0.0}};

/// Makes the node of V: H at the momenta for which nothing moves; the momentum of time stays as it is.
/// @param drifts see Choice
int at_rest(ExpressionGraph& graph, int energy, bool timed, const std::vector<double>& drifts) {
  const auto n = static_cast<std::size_t>(graph.inputs()) / 2;
  std::vector<int> arguments(n);
  std::iota(arguments.begin(), arguments.end(), 0);
  arguments.resize(2 * n, graph.constant(0.0));
  if (timed) arguments.back() = graph.inputs() - 1;
  if (!drifts.empty()) {
    const std::vector<int> slope = Reverse(graph).gradient(energy);
    std::vector<int> momenta;
    for (std::size_t i = 0; i < drifts.size(); ++i)
      momenta.push_back(graph.binary(Operation::multiply, graph.constant(-1.0 / drifts[i]),
                                     graph.substitute(graph, slope[n + i], arguments)));
    std::ranges::copy(momenta, arguments.begin() + static_cast<std::ptrdiff_t>(n));
  }
  return graph.substitute(graph, energy, arguments);
}

/// Makes the node of \f$\ell\f$ of the energy monitors.
int liveliness_of(ExpressionGraph& graph, int energy, const EnergyAtStart& energy_at_start, bool timed,
                  const Choice& constants) {
  const int half = graph.binary(Operation::multiply, graph.constant(0.5), energy);
  const int moving = graph.binary(Operation::subtract, half, at_rest(graph, energy, timed, constants.drifts));
  const int level = energy_at_start.is_open()
                        ? energy_at_start.level
                        : graph.constant(0.5 * energy_at_start.value + constants.kinetic);
  return graph.binary(Operation::add, moving, level);
}

/// Makes the monitor `acceleration`, whose rate is the power 3/8 of \f$1 + \sum_i (w_i\, \partial H/\partial
/// q_i)^2\f$: see Choice::accelerations.
Candidate accelerated(const std::shared_ptr<ExpressionGraph>& graph, int energy,
                      EnergyAtStart energy_at_start, const Choice& constants) {
  const std::vector<int> slope = Reverse(*graph).gradient(energy);
  int sum = graph->constant(1.0);
  for (std::size_t i = 0; i < constants.accelerations.size(); ++i) {
    const int a = graph->binary(Operation::multiply, graph->constant(constants.accelerations[i]), slope[i]);
    sum = graph->binary(Operation::add, sum, graph->binary(Operation::multiply, a, a));
  }
  return {"acceleration", 0.375, graph, energy, energy_at_start, sum};
}

/// The poles and the bends of H.
struct Singular {
  Poles poles;
  Bends bends;

  Singular(const ExpressionGraph& graph, const OrbitQuestion& question)
      : poles(graph, question.energy), bends(graph, question.energy, question.timed) {}
  Singular(const ExpressionGraph& graph, int energy, const Bends& measured)
      : poles(graph, energy), bends(measured) {}
  [[nodiscard]] bool none() const { return poles.none() && bends.none(); }
  /// Number of the constants of the monitor `poles`.
  [[nodiscard]] std::size_t constants() const { return 2 + 2 * poles.size() + bends.size(); }
  /// Makes the node of its rate. @param constants see Choice::poles
  int rate(ExpressionGraph& graph, const EnergyAtStart& energy_at_start,
           const std::vector<double>& constants) const {
    const Factor start =
        energy_at_start.is_open() ? Factor(graph, energy_at_start.node) : energy_at_start.value;
    return poles.rate(graph, start, constants,
                      bends.frequency(graph, constants.data() + 2 + 2 * poles.size()));
  }
};

/// Makes the monitor `poles`, which combines the frequency near poles and bends with a constant one: see
/// Choice::poles.
Candidate polar(const std::shared_ptr<ExpressionGraph>& graph, const OrbitQuestion& question,
                EnergyAtStart energy_at_start, const Choice& constants) {
  const int lively = constants.poles.empty()
                         ? graph->constant(1.0)
                         : Singular(*graph, question).rate(*graph, energy_at_start, constants.poles);
  return {"poles", 1.0, graph, question.energy, energy_at_start, lively};
}

Candidate given(const std::shared_ptr<ExpressionGraph>& graph, const OrbitQuestion& question,
                EnergyAtStart energy_at_start) {
  return {"given", -1.0, graph, question.energy, energy_at_start, question.given};
}

}  // namespace

std::vector<double> accelerations(const Sketch& sketch, const VectorX& metric, Eigen::Index seen) {
  std::vector<double> weights(static_cast<std::size_t>(seen), 0.0);
  if (sketch.samples.empty()) return weights;
  VectorX low = sketch.samples.front().z;
  VectorX high = low;
  for (const Sketch::Sample& sample : sketch.samples)
    low = low.cwiseMin(sample.z), high = high.cwiseMax(sample.z);
  double root = 0.0;  // mean of the square roots, in which short peaks count little
  for (Eigen::Index i = 0; i < seen; ++i)
    if (high[i] > low[i]) weights[static_cast<std::size_t>(i)] = metric[i] / (high[i] - low[i]);
  const Eigen::Map<const VectorX> weight(weights.data(), seen);
  VectorX weighted(seen);
  for (const Sketch::Sample& sample : sketch.samples) {
    weighted = weight.cwiseProduct(sample.slope.segment(metric.size(), seen));
    root += sample.h / sketch.time * std::sqrt(norm(weighted));
  }
  for (double& each : weights)
    each /= root * root > 0.0 ? root * root : 1.0;
  return weights;
}

std::string names_of_monitors() {
  std::string names;
  for (const Entry& entry : known_monitors)
    names += (names.empty() ? "" : ", ") + std::string(entry.name);
  return names;
}

bool is_monitor(std::string_view name) {
  return std::ranges::any_of(known_monitors, [&](const Entry& entry) { return name == entry.name; });
}

namespace {

const Entry& entry_of(std::string_view name) {
  return *std::ranges::find_if(known_monitors, [&](const Entry& it) { return name == it.name; });
}

/// Makes the monitor of this name. @param graph graph of the question, to which the monitor is added
Candidate candidate_in(const std::shared_ptr<ExpressionGraph>& graph, std::string_view name,
                       const OrbitQuestion& question, EnergyAtStart energy_at_start,
                       const Choice& constants) {
  const int energy = question.energy;
  if (question.given >= 0) return given(graph, question, energy_at_start);
  const Entry& entry = entry_of(name);
  if (entry.alpha == 0.0) return {entry.name, 0.0, graph, energy, energy_at_start, -1};
  if (name == "acceleration") return accelerated(graph, energy, energy_at_start, constants);
  if (name == "poles") return polar(graph, question, energy_at_start, constants);
  const int lively = liveliness_of(*graph, energy, energy_at_start, question.timed, constants);
  return {entry.name, entry.alpha, graph, energy, energy_at_start, lively};
}

}  // namespace

Candidate candidate(std::string_view name, const OrbitQuestion& question, double energy_at_start,
                    const Choice& constants) {
  return candidate_in(std::make_shared<ExpressionGraph>(question.graph), name, question, energy_at_start,
                      constants);
}

Candidate candidate(std::string_view name, const OrbitQuestion& question,
                    std::shared_ptr<const Formulas> formulas) {
  if (question.given >= 0) return {"given", -1.0, std::move(formulas)};
  return {std::string(name), entry_of(name).alpha, std::move(formulas)};
}

std::shared_ptr<const Formulas> formulas_of(const Choice& choice, const OrbitQuestion& question) {
  const auto graph = std::make_shared<ExpressionGraph>(question.graph);
  const bool fixed = question.given < 0 && entry_of(choice.name).alpha == 0.0;
  Candidate it =
      candidate_in(graph, choice.name, question, fixed ? EnergyAtStart(0.0) : EnergyAtStart(*graph), choice);
  it.supplied = question.gradient;
  return it.formulas();
}

namespace {

/// The menu in the making.
class MenuWriter {
 public:
  MenuWriter(const OrbitQuestion& question, double energy_at_start, const Sketch& sketch, const Bends& bends,
             const VectorX& metric, Choice& constants, double operations)
      : question_(question), energy_at_start_(energy_at_start), sketch_(sketch), bends_(bends),
        metric_(metric), constants_(constants), graph_(std::make_shared<ExpressionGraph>(question.graph)),
        strength_(strengths(sketch, metric)) {
    // Approximate number of operations of a sweep, counted on eight Hamiltonians of 2 to 32 degrees of
    // freedom; the price is right within a quarter. The exact number is known only once the programs are
    // made.
    nodes_ = question.energy - graph_->inputs();
    plain_ = std::max(operations - 0.45 * nodes_, 0.0);
    monitored_ = plain_ + 30.0 + (constants.drifts.empty() ? 1.2 : 2.4) * nodes_ + 2.0 * graph_->inputs();
    // Errors of the momentum of time do not count.
    if (question.timed) strength_[metric.size() - 1] = infinity;
  }

  /// Adds fixed steps and the monitors of the energy.
  void add_energies(const Resting& resting) {
    const double kinetic = constants_.kinetic;
    menu_.emplace_back("fixed", 0.0, graph_, question_.energy, energy_at_start_, -1);
    if (kinetic > 0.0 && moves()) {
      const int lively =
          liveliness_of(*graph_, question_.energy, energy_at_start_, question_.timed, constants_);
      for (const auto& [name, alpha] : known_monitors)
        if (std::string_view(name).starts_with("energy"))
          menu_.emplace_back(name, alpha, graph_, question_.energy, energy_at_start_, lively);
    }
    rounding_ =
        std::numeric_limits<double>::epsilon() * std::max(std::abs(energy_at_start_), std::abs(kinetic));
    // H + p^t is zero at the start, but its terms may be far larger.
    if (question_.timed && menu_.size() > 1) {
      const double of_terms =
          RoundedFormula(question_.graph, question_.energy).rounding(sketch_.samples.front().z);
      if (of_terms > 30.0 * rounding_) rounding_ = of_terms;
    }
    Measured measured;
    if (menu_.size() > 1) measured = measure(sketch_, resting, energy_at_start_, kinetic, strength_);
    for (Candidate& it : menu_)
      look(it, it.fixed() ? plain_ : monitored_, measured);
  }
  /// Adds the monitor of the user.
  void add_given() {
    menu_.push_back(given(graph_, question_, energy_at_start_));
    look(menu_.back(), monitored_, measure(sketch_, *graph_, question_.given, strength_));
  }
  /// Adds the monitor of poles and bends, if H has any. Beside a candidate that is better, it would only be
  /// one more to try. @param asked whether to add it anyway
  void add_poles(bool asked) {
    const Singular singular(*graph_, question_.energy, bends_);
    if (singular.none()) return;
    if (!constants_.poles.empty()) {
      menu_.push_back(polar_with(singular, constants_.poles));
      return;
    }
    const double others = std::ranges::min_element(menu_, {}, &Candidate::outlook)->outlook;
    std::vector<double> constants =
        singular.poles.constants(sketch_, metric_, metric_.size() - (question_.timed ? 1 : 0));
    constants.insert(constants.begin(),
                     {-1.0, constants_.kinetic > 0.0 ? constants_.kinetic : constants_.energy_scale});
    std::optional<Candidate> best;
    const auto offer = [&](const std::vector<double>& bends) {
      std::vector<double> all = constants;
      all.insert(all.end(), bends.begin(), bends.end());
      Candidate it = polar_with(singular, all);
      if (best && !(it.outlook < best->outlook)) return;
      best = std::move(it);
      constants_.poles = std::move(all);
    };
    if (!singular.poles.none()) offer(std::vector<double>(singular.bends.size(), 0.0));
    for (std::size_t k = 0; k < singular.poles.size(); ++k)
      if (bends_.takes(singular.poles.node(k))) constants[2 * k + 2] = 0.0;
    if (bends_.matter()) offer(bends_.speeds());
    if (best && (asked || best->outlook <= others)) menu_.push_back(*std::move(best));
  }
  /// Adds the monitor `acceleration`.
  void add_acceleration() {
    menu_.push_back(accelerated(graph_, question_.energy, energy_at_start_, constants_));
    look(menu_.back(), 4.0 * plain_ + 50.0, measure(sketch_, *graph_, menu_.back().rate_node(), strength_));
  }

  /// Returns true if the sketch shows where the motion goes.
  [[nodiscard]] bool moves() const { return sketch_.samples.size() > 1; }
  /// The least number of steps, of one radian at most, that a candidate needs for the sketch.
  [[nodiscard]] double fewest_steps() const {
    double steps = infinity;
    for (const Candidate& it : menu_)
      if (std::isfinite(it.outlook)) steps = std::min(steps, it.fictive * it.longest);
    return steps;
  }
  /// The candidates that may do, the best first. @param wanted name of one that stays unless it cannot run
  std::vector<Candidate> sorted(std::string_view wanted) && {
    std::erase_if(menu_, [&](const Candidate& it) {
      const bool named =
          it.name == wanted && it.name != "given" && it.longest > 0.0 && std::isfinite(it.longest);
      return !it.fixed() && !named && !std::isfinite(it.outlook);
    });
    std::ranges::stable_sort(menu_, {}, &Candidate::outlook);
    return std::move(menu_);
  }

 private:
  /// The monitor of poles and bends with these constants. @param constants see Choice::poles; \f$w_0\f$ is
  /// found and set if it is negative
  Candidate polar_with(const Singular& singular, std::vector<double>& constants) {
    std::vector<double> beside = constants;  // those of the monitor without a constant frequency
    beside.front() = 0.0;
    Measured frequency =
        measure(sketch_, *graph_, singular.rate(*graph_, energy_at_start_, beside), strength_, true);
    if (constants.front() < 0.0) constants.front() = background(sketch_, frequency);
    for (double& each : frequency.lively)
      each = with_constant(each, constants.front());
    Candidate made{"poles",          1.0,
                   graph_,           question_.energy,
                   energy_at_start_, singular.rate(*graph_, energy_at_start_, constants)};
    const auto bends = constants.end() - static_cast<std::ptrdiff_t>(singular.bends.size());
    const auto unused = static_cast<std::size_t>(std::count(bends, constants.end(), 0.0));
    const bool with_bends = unused < singular.bends.size();
    const auto features = static_cast<double>(singular.poles.size() + singular.bends.size() - unused);
    look(made, plain_ + 30.0 + 18.0 * features + nodes_ + 2.0 * graph_->inputs(), frequency,
         constants.front(), with_bends);
    // Gradients at a bend are steep for so short a time that the largest one says little.
    if (with_bends) made.noise = sketch_.radians > 0.0 ? rounding_ * frequency.shaken / sketch_.radians : 0.0;
    return made;
  }
  /// Sets what the sketch says of a candidate. @param operations those of a sweep @param measured what its
  /// monitor follows, along the sketch @param constant a constant frequency beside that, if any
  /// @param with_bends whether it follows bends
  void look(Candidate& it, double operations, const Measured& measured, double constant = 0.0,
            bool with_bends = false) {
    double least = infinity, most = 0.0, last = 0.0;
    for (std::size_t k = 0; k < sketch_.samples.size() && least > 0.0; ++k) {
      const Sketch::Sample& sample = sketch_.samples[k];
      const double g = it.fixed() ? 1.0 : it.rate_of(measured.lively[k]);
      it.fictive += sample.h / g;
      it.longest = std::max(it.longest, g * sample.frequency);
      least = g > 0.0 && std::isfinite(g) ? std::min(least, g) : 0.0;
      most = std::max(most, g), last = g;
    }
    const bool ahead = bends_.ahead() > 0.0;
    if (ahead && !with_bends && it.name != "given") it.longest = std::max(it.longest, last * bends_.ahead());
    if (constant > 0.0) it.longest = std::max(it.longest, fastest_change(measured, constant));
    it.noise = it.fixed() ? 0.0 : std::abs(it.alpha()) * rounding_ * measured.steepest;
    it.outlook = Candidate::price_of_sweep(operations, graph_->inputs()) * it.fictive * it.longest;
    const bool idle = !it.fixed() && it.name != "given" && !(ahead && with_bends) && !(most > 1.15 * least);
    if (!(least > 0.0) || !std::isfinite(it.outlook) || idle) it.outlook = infinity;
    if (it.fixed() && sketch_.samples.empty()) it.outlook = 1.0, it.fictive = 1.0;
  }

  const OrbitQuestion& question_;
  double energy_at_start_;
  const Sketch& sketch_;
  const Bends& bends_;
  const VectorX& metric_;
  Choice& constants_;
  std::shared_ptr<ExpressionGraph> graph_;
  VectorX strength_;
  double nodes_ = 0.0, plain_ = 0.0, monitored_ = 0.0;  // operations of H, and of a sweep without and with g
  double rounding_ = 0.0;                               // of H
  std::vector<Candidate> menu_;
};

}  // namespace

std::vector<Candidate> candidates(const OrbitQuestion& question, double energy_at_start, const Sketch& sketch,
                                  const Bends& bends, double radians, const Resting& resting,
                                  const VectorX& metric, Choice& constants, double operations) {
  const std::string& wanted = question.options.monitor.name;
  MenuWriter menu(question, energy_at_start, sketch, bends, metric, constants, operations);
  menu.add_energies(resting);
  if (question.given >= 0) menu.add_given();
  if (menu.moves()) {
    // Finding the poles takes some microseconds: do so only if steps might be fewer and many would be saved.
    const bool asked = wanted == "poles";
    if (asked || menu.fewest_steps() > (radians > 100.0 ? 1.2 : 1.5) * sketch.radians) menu.add_poles(asked);
    // Useful where the fastest part of the motion makes all steps many times shorter than the rest needs, as
    // when two of many bodies meet.
    if (wanted == "acceleration" || menu.fewest_steps() > 5.0 * sketch.radians) menu.add_acceleration();
  }
  return std::move(menu).sorted(wanted);
}

}  // namespace avi::detail

namespace avi {

Formula monitor_of(const Choice& choice, const Formula& hamiltonian, double energy_at_start) {
  const Formula h = hamiltonian.with_constants();
  require(h.inputs() % 2 == 0, "Number of arguments of H", h.inputs(), "even: those of H(q, p)");
  require(detail::is_monitor(choice.name), "Monitor", choice.name, "one of ", detail::names_of_monitors(),
          "; a monitor of one's own is known already");
  const detail::OrbitQuestion question{.graph = h.graph(), .energy = h.node()};
  const auto n = static_cast<std::size_t>(h.inputs() / 2);
  const auto fits = [](const std::vector<double>& constants, std::size_t size) {
    return constants.empty() || constants.size() == size;
  };
  require(fits(choice.accelerations, n) && fits(choice.drifts, n) &&
              fits(choice.poles, detail::Singular(h.graph(), question).constants()),
          "H of a monitor", "another one", "that for which the choice was made");
  return detail::candidate(choice.name, question, energy_at_start, choice).formula();
}

}  // namespace avi
