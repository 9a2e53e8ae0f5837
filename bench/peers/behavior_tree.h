// Behaviour trees in the manner of BehaviorTree.CPP: nodes with a virtual `tick`, leaves that hold a std::function as its
// SimpleConditionNode and SimpleActionNode do. Without its string-keyed blackboard, XML, and locks, which would cost more.
#pragma once

#include <functional>
#include <memory>
#include <utility>
#include <vector>

namespace peers::tree {

enum class NodeStatus { kSuccess, kFailure };

class Node {
 public:
  Node() = default;
  Node(const Node&) = delete;
  Node& operator=(const Node&) = delete;
  virtual ~Node() = default;
  virtual NodeStatus tick() = 0;
};
using NodePtr = std::unique_ptr<Node>;

class Parent : public Node {
 public:
  explicit Parent(std::vector<NodePtr> children) : children_(std::move(children)) {}

 protected:
  std::vector<NodePtr> children_;
};

/// Succeeds if all children do; stops at the first that fails.
class Sequence final : public Parent {
 public:
  using Parent::Parent;
  NodeStatus tick() override {
    for (const NodePtr& child : children_) {
      if (child->tick() == NodeStatus::kFailure) return NodeStatus::kFailure;
    }
    return NodeStatus::kSuccess;
  }
};

/// Fails if all children do; stops at the first that succeeds.
class Fallback final : public Parent {
 public:
  using Parent::Parent;
  NodeStatus tick() override {
    for (const NodePtr& child : children_) {
      if (child->tick() == NodeStatus::kSuccess) return NodeStatus::kSuccess;
    }
    return NodeStatus::kFailure;
  }
};

/// Ticks all children, whatever they say.
class ParallelAll final : public Parent {
 public:
  using Parent::Parent;
  NodeStatus tick() override {
    for (const NodePtr& child : children_) (void)child->tick();
    return NodeStatus::kSuccess;
  }
};

class Condition final : public Node {
 public:
  explicit Condition(std::function<bool()> holds) : holds_(std::move(holds)) {}
  NodeStatus tick() override { return holds_() ? NodeStatus::kSuccess : NodeStatus::kFailure; }

 private:
  std::function<bool()> holds_;
};

class Action final : public Node {
 public:
  explicit Action(std::function<void()> act) : act_(std::move(act)) {}
  NodeStatus tick() override {
    act_();
    return NodeStatus::kSuccess;
  }

 private:
  std::function<void()> act_;
};

template <class Kind, class... Children>
NodePtr of(Children... children) {
  std::vector<NodePtr> list;
  (list.push_back(std::move(children)), ...);
  return std::make_unique<Kind>(std::move(list));
}
template <class... Children>
NodePtr sequence(Children... children) { return of<Sequence>(std::move(children)...); }
template <class... Children>
NodePtr fallback(Children... children) { return of<Fallback>(std::move(children)...); }
template <class... Children>
NodePtr all(Children... children) { return of<ParallelAll>(std::move(children)...); }
template <class F>
NodePtr when(F holds) { return std::make_unique<Condition>(std::move(holds)); }
template <class F>
NodePtr act(F action) { return std::make_unique<Action>(std::move(action)); }

}  // namespace peers::tree
