#include "planners/method.h"

#include <array>

#include "planners/methods.h"

namespace kb::planners {

namespace {

constexpr Draw picture_of(std::string_view name) {
#define KB_METHOD(function, name, knowledge, touch, moving, random, summary)
#define KB_PICTURE(whose, function) \
  if (name == whose) return function;
#include "planners/methods.def"
#undef KB_METHOD
#undef KB_PICTURE
  return nullptr;
}

constexpr std::array kMethods = {
#define KB_PICTURE(name, function)
#define KB_METHOD(function, name, knowledge, touch, moving, random, summary) \
  Method{name, Knowledge::knowledge, Touch::touch, moving, random, function, picture_of(name), summary},
#include "planners/methods.def"
#undef KB_METHOD
#undef KB_PICTURE
};

constexpr std::array<std::string_view, 3> kKnowledge = {"full map", "local range", "contact"};

// What the checker finds wrong with the path of a result that says that it has reached the goal.
std::optional<Objection> object_to(const Method& method, const Problem& problem, const Result& result) {
  const Grid& grid = *problem.grid;
  const Point start = grid.centre(problem.start_cell()), goal = grid.centre(problem.goal_cell());
  // A planner on cells begins and ends in the centres of cells, a continuous one at the points themselves; both are within the same
  // cell.
  const double tolerance = (problem.goal_tolerance_cells + 0.7072) * grid.cell_m();
  if (auto fault = check_path(grid, result.path, method.touch, start, goal, tolerance)) return fault;
  if (problem.movers == nullptr) return std::nullopt;
  std::vector<Cell> cells;
  for (const Point p : result.path) cells.push_back(grid.cell_at(p));
  return check_walk(grid, problem.movers, cells);
}

}  // namespace

std::string_view name(Knowledge knowledge) { return kKnowledge[static_cast<std::size_t>(knowledge)]; }

std::span<const Method> methods() { return kMethods; }

const Method* find_method(std::string_view name) {
  for (const Method& method : kMethods) {
    if (method.name == name) return &method;
  }
  return nullptr;
}

Result plan(const Method& method, const Problem& problem, const RunOptions& run) {
  if (const Fault fault = find_fault(problem); fault != Fault::kNone) return rejected(fault);
  if (problem.movers != nullptr && !method.moving) return rejected(Fault::kMoversUnknown);
  Result result = method.run(problem, run);
  if (result.outcome != Outcome::kReached) return result;
  if (const auto objection = object_to(method, problem, result)) {
    result.outcome = Outcome::kNumeric;
    result.refused = objection->what;
  }
  return result;
}

}  // namespace kb::planners
