// Fuzzy numbers.
#include <utility>

#include "compiler/syntax/tree_builder.h"

namespace kb::syntax {

void TreeBuilder::begin_shape(Span name) {
  shape_ = Shape{};
  shape_argument_ = Shape::Argument{};
  shape_.name = name_at(name);
}

void TreeBuilder::add_shape_argument(Span span) {
  shape_argument_.span = span;
  shape_.arguments.push_back(std::exchange(shape_argument_, Shape::Argument{}));
}

void TreeBuilder::add_shape_argument(Span span, Span label) {
  shape_argument_.label = name_at(label);
  add_shape_argument(span);
}

void TreeBuilder::add_shape_range(Span span, Id last) {
  shape_argument_.number = numbers_[last - 1];
  shape_argument_.to = numbers_[last];
  add_shape_argument(span);
}

TreeBuilder::Id TreeBuilder::shape(Span span) {
  shape_.span = span;
  tree_.shapes.push_back(std::exchange(shape_, Shape{}));
  return static_cast<Id>(tree_.shapes.size() - 1);
}

void TreeBuilder::prototype(Span name, Id shape) {
  tree_.statements.push_back({Span{}, Prototype{name_at(name), ShapeId{shape}}});
  clear();
}

}  // namespace kb::syntax
