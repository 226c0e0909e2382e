// SPDX-License-Identifier: MIT

#include "model/composite.h"
#include "model/plugin.h"

namespace plumb {

/// Puts a group into the scene, moved by toWorld.
///
/// The group is named by a <ref>, and may stand before or after. toWorld may shear, scale unevenly and mirror; a mirror
/// keeps the front of each surface its front. It is rounded to 32-bit floats, and may scale by up to 1e9. An instance has no
/// BSDF of its own: the shapes in the group have theirs. In the layer `object`, an instance is one object.
///
///     toWorld   transform   from the space of the group to the world   (default: the identity)
///
///         <shape type="instance">
///             <ref id="pawn"/>
///             <transform name="toWorld"><scale value="1,2,1"/><translate value="3,0,0"/></transform>
///         </shape>
class InstanceOfGroup final : public Composite {
public:
    explicit InstanceOfGroup(const Params& params) { to_world = params.transform("toWorld"); }
};

template std::unique_ptr<Composite> build<InstanceOfGroup>(const Params&);

} // namespace plumb
