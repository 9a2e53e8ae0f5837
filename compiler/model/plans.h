// Detours that the compiler plans: `detours on R [when C]`.
#pragma once

#include "compiler/model/draft.h"

namespace kb::model {

/// Plans the detours of one route: rows of `Detour`, and of `Retreat` and `Rejoin` if these are declared.
void plan_route(Draft& draft, const syntax::Tree& tree, const syntax::Statement& statement, const syntax::Detours& detours);

/// Reports that no route has this name, unless that was reported before.
void report_unknown_route(Draft& draft, const syntax::Name& name);

}  // namespace kb::model
