#include "tools/kbc/vda5050/stretch.h"

#include <algorithm>

namespace kb::vda5050 {

void Stretch::begin(const std::vector<Node>& nodes, const std::vector<Edge>& edges, std::size_t first, std::size_t last, Start start) {
  ++task_.number;
  close();
  task_.start = start;
  first_ = last_ = first;
  append(nodes, edges, last);
}

void Stretch::forget_passed(std::size_t nodes, std::size_t visits) {
  const std::size_t gone = std::max<std::size_t>(visits, 1) - 1 - task_.passed;
  task_.way.erase(task_.way.begin(), task_.way.begin() + static_cast<std::ptrdiff_t>(gone));
  task_.passed += gone;
  marks_.erase(marks_.begin(), marks_.begin() + static_cast<std::ptrdiff_t>(nodes - first_));
  std::erase_if(ends_, [visits](std::size_t end) { return end < visits; });
  first_ = 0;
  last_ -= nodes;
}

void Stretch::grow(const std::vector<Node>& nodes, const std::vector<Edge>& edges, std::size_t last) {
  ends_.push_back(task_.visits());
  task_.way.pop_back();   // the last visit, which has no exit: the next edge begins with the same landmark
  append(nodes, edges, last);
}

void Stretch::append(const std::vector<Node>& nodes, const std::vector<Edge>& edges, std::size_t last) {
  for (; last_ < last; ++last_) {
    task_.way.insert(task_.way.end(), edges[last_].way.begin(), edges[last_].way.end());
    marks_.push_back(task_.visits());
  }
  task_.way.push_back({nodes[last].landmark});
}

void Stretch::cut(std::size_t last) {
  marks_.resize(last - first_);
  last_ = last;
  task_.way.resize(marks_.empty() ? 1 : marks_.back() + 1 - task_.passed);
  task_.way.back().exit.clear();
}

void Stretch::close() {
  task_.way.clear();
  task_.passed = 0;
  marks_.clear();
  ends_.clear();
}

std::size_t Stretch::node_at(std::size_t visits) const {
  const auto beyond = std::upper_bound(marks_.begin(), marks_.end(), std::max<std::size_t>(visits, 1) - 1);
  return first_ + static_cast<std::size_t>(beyond - marks_.begin());
}

bool Stretch::ended_at(std::size_t visits) const { return std::find(ends_.begin(), ends_.end(), visits) != ends_.end(); }

}  // namespace kb::vda5050
