// SPDX-License-Identifier: MIT
#include "cli/development_options.h"

#include "plumb/base/error.h"
#include "plumb/settings/settings_header.h"

namespace plumb {

Development development_of(const Metadata& header, const DevelopmentOptions& options)
{
    Development development;
    try {
        development = settings_of_header(header).output.development;
    } catch (
        const Error&) { // of another version, or of nobody we know: its image can be looked at all the same
    }
    return {options.exposure.value_or(development.exposure), options.curve.value_or(development.curve)};
}

} // namespace plumb
