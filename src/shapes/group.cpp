// SPDX-License-Identifier: MIT

#include "model/composite.h"
#include "model/plugin.h"

namespace plumb {

/// Shapes for instances, which put them into the scene any number of times. A group alone is invisible.
///
/// It stands in <scene>, has an id, and holds one or more <shape> or <mesh>, each with its own BSDF. The shapes, and the
/// structure that rays look through, are in memory once, however many instances there are. Emitters, instances and other
/// groups cannot stand in it.
///
///         <shape type="group" id="pawn">
///             <shape type="sphere"> <float name="radius" value="0.3"/> </shape>
///             <shape type="disk"> <vector name="normal" value="0 1 0"/> </shape>
///         </shape>
class GroupOfShapes final : public Composite {
public:
    explicit GroupOfShapes(const Params&) {}
};

template std::unique_ptr<Composite> build<GroupOfShapes>(const Params&);

} // namespace plumb
