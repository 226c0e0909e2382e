// SPDX-License-Identifier: MIT
#pragma once

// The body of build<T>: included by plugin files only, each of which ends with
//
//     template std::unique_ptr<Bsdf> build<Diffuse>(const Params&);

#include "plumb/model/params.h"

namespace plumb {

template <class T, class Kind>
std::unique_ptr<Kind> build(const Params& params)
{
    return std::make_unique<T>(params);
}

} // namespace plumb
