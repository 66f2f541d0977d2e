#include <avi/optim/minimise.hpp>

#include <cmath>
#include <cstddef>
#include <cstdio>
#include <random>
#include <vector>

// Which words make a message unwanted? 8000 messages of 20 words each from a vocabulary of 3000, rare and
// common ones; word j has a hidden weight, and a message is unwanted with probability sigmoid(sum of its
// words' weights). The weights are found again by regularised logistic regression, and tried on 2000 messages
// that were not seen.

constexpr int words = 3000, seen = 8000, fresh = 2000, length = 20;

struct Message {
  int word[length];
  double label;  // +1 or -1
};

double sigmoid(double z) { return z < 0.0 ? std::exp(z) / (1.0 + std::exp(z)) : 1.0 / (1.0 + std::exp(-z)); }

double score(const Message& message, const avi::VectorX& weights) {
  double sum = 0.0;
  for (int word : message.word)
    sum += weights[word];
  return sum;
}

int main() {
  std::mt19937_64 bits(1);
  const auto uniform = [&] { return (static_cast<double>(bits() >> 11) + 0.5) * 0x1p-53; };
  avi::VectorX hidden(words);
  for (double& weight : hidden)
    weight = 2.0 * uniform() - 1.0;
  std::vector<Message> messages(seen + fresh);
  for (Message& message : messages) {
    for (int& word : message.word)
      word = static_cast<int>(words * std::pow(uniform(), 2.0));  // word j with density ~ j^(-1/2)
    message.label = uniform() < sigmoid(2.0 * score(message, hidden)) ? 1.0 : -1.0;
  }

  const double ridge = 1e-4;
  const auto loss = [&](const avi::VectorX& x, avi::VectorX& gradient) {
    gradient = ridge * x;
    double sum = 0.0;
    for (int i = 0; i < seen; ++i) {
      const Message& message = messages[static_cast<std::size_t>(i)];
      const double z = message.label * score(message, x);
      sum += z > 0.0 ? std::log1p(std::exp(-z)) : std::log1p(std::exp(z)) - z;
      const double slope = -message.label * sigmoid(-z) / seen;
      for (int word : message.word)
        gradient[word] += slope;
    }
    return sum / seen + 0.5 * ridge * avi::dot(x, x);
  };

  const auto run = avi::minimise(loss, avi::VectorX::Zero(words), {.relative = 1e-6, .check_gradient = true});
  if (!run.ok()) {
    std::printf("%s\n", run.message.c_str());
    return 1;
  }
  int right = 0, possible = 0;
  for (std::size_t i = seen; i < messages.size(); ++i) {
    right += messages[i].label * score(messages[i], run.last.x) > 0.0;
    possible += messages[i].label * score(messages[i], hidden) > 0.0;
  }
  std::printf("%d weights, loss %.6f, %s\n", words, run.last.value,
              run.gradient_evaluations < 100 ? "fewer than 100 gradients" : "100 gradients or more");
  std::printf("%.1f %% of %d new messages told right; the hidden weights themselves tell %.1f %%\n",
              100.0 * right / fresh, fresh, 100.0 * possible / fresh);
  return 0;
}
