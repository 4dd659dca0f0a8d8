#include "stage_tracer/steady_watch.hpp"

#include <algorithm>
#include <cmath>

#include "stage_tracer/removal.hpp"

namespace cupola {
namespace {

constexpr double least_ratio = 0.3;
constexpr double most_ratio = 0.95;

/// Adds a field with its weights to a mean.
template <typename Window>
void blend(Window& mean, std::size_t weight, const Window& other, std::size_t other_weight) {
  if (weight == 0) {
    mean = other;
    return;
  }
  for (std::size_t c = 0; c < mean.capacity.size(); ++c) {
    const double a = static_cast<double>(weight) * mean.capacity[c];
    const double b = static_cast<double>(other_weight) * other.capacity[c];
    if (a + b > 0) {
      mean.temperature[c] = static_cast<float>((a * mean.temperature[c] + b * other.temperature[c]) / (a + b));
      mean.capacity[c] = static_cast<float>((a + b) / static_cast<double>(weight + other_weight));
    }
  }
}

}  // namespace

void SteadyWatch::add(const std::vector<double>& capacity, const std::vector<double>& temperature) {
  Window window{{capacity.begin(), capacity.end()}, {temperature.begin(), temperature.end()}};
  ++added_;
  blend(open_, open_count_, window, 1);
  if (++open_count_ < joined_) return;
  windows_.push_back(std::move(open_));
  open_ = {};
  open_count_ = 0;
  if (windows_.size() >= most_windows) join_neighbours();
  const auto now = remaining();
  changes_.push_back(now ? now->change : -1);
}

void SteadyWatch::join_neighbours() {
  for (std::size_t i = 0; i + 1 < windows_.size(); i += 2) {
    blend(windows_[i], 1, windows_[i + 1], 1);
    if (i > 0) windows_[i / 2] = std::move(windows_[i]);  // a vector moved onto itself would be empty
  }
  windows_.resize(windows_.size() / 2);
  joined_ *= 2;
}

std::optional<RemainingChange> SteadyWatch::remaining() const {
  if (windows_.size() < least_windows) return std::nullopt;
  const std::size_t length = windows_.size() / 4;
  const auto block = [&](std::size_t from_end) {
    Window mean;
    const std::size_t begin = windows_.size() - (from_end + 1) * length;
    for (std::size_t i = 0; i < length; ++i) blend(mean, i, windows_[begin + i], 1);
    return mean;
  };
  const Window a = block(2);
  const Window b = block(1);
  const Window c = block(0);
  double earlier = 0;
  double both = 0;
  double later = 0;
  double norm = 0;
  for (std::size_t i = 0; i < c.capacity.size(); ++i) {
    const double weight = std::min({a.capacity[i], b.capacity[i], c.capacity[i]});
    if (weight <= 0) continue;
    const double before = double{b.temperature[i]} - a.temperature[i];
    const double after = double{c.temperature[i]} - b.temperature[i];
    const double above = c.temperature[i] - enthalpy_zero;
    earlier += weight * before * before;
    both += weight * before * after;
    later += weight * after * after;
    norm += weight * above * above;
  }
  if (!(norm > 0)) return std::nullopt;
  RemainingChange result;
  result.last = std::sqrt(later / norm);
  result.ratio = earlier > 0 ? both / earlier : 0;
  if (result.ratio > most_ratio) return std::nullopt;
  const double ratio = std::max(result.ratio, least_ratio);
  result.change = ratio / (1 - ratio) * result.last;
  return result;
}

int SteadyWatch::below(double wanted) const {
  int count = 0;
  for (auto change = changes_.rbegin(); change != changes_.rend() && *change >= 0 && *change <= wanted; ++change) {
    ++count;
  }
  return count;
}

std::vector<double> SteadyWatch::row() const {
  const std::size_t cells = windows_.empty() ? open_.capacity.size() : windows_.front().capacity.size();
  std::vector<double> result = {static_cast<double>(cells), static_cast<double>(windows_.size()),
                                static_cast<double>(added_), static_cast<double>(joined_),
                                static_cast<double>(open_count_)};
  const auto append = [&](const Window& window) {
    result.insert(result.end(), window.capacity.begin(), window.capacity.end());
    result.insert(result.end(), window.temperature.begin(), window.temperature.end());
  };
  for (const Window& window : windows_) append(window);
  if (open_count_ > 0) append(open_);
  result.insert(result.end(), changes_.begin(), changes_.end());
  return result;
}

void SteadyWatch::restore(const std::vector<double>& row) {
  *this = {};
  const auto count = [&](std::size_t i) { return static_cast<std::size_t>(row.at(i)); };
  const std::size_t cells = count(0);
  added_ = count(2);
  joined_ = count(3);
  open_count_ = count(4);
  auto next = row.begin() + 5;
  const auto take = [&] {
    const auto middle = next + static_cast<std::ptrdiff_t>(cells);
    const auto end = middle + static_cast<std::ptrdiff_t>(cells);
    Window window{{next, middle}, {middle, end}};
    next = end;
    return window;
  };
  for (std::size_t i = 0; i < count(1); ++i) windows_.push_back(take());
  if (open_count_ > 0) open_ = take();
  changes_.assign(next, row.end());
}

}  // namespace cupola
