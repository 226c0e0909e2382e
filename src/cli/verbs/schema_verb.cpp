// SPDX-License-Identifier: MIT
#include "cli/console.h"
#include "cli/usage_error.h"
#include "cli/verb_file.h"
#include "reports/exit_codes.h"
#include "reports/scene_schema.h"

#include <fmt/format.h>

namespace plumb {

namespace {

int run(const VerbOptions& options)
{
    const std::string format = options.subjects.empty() ? "rng" : options.subject();
    if (format == "rng")
        print_output(relax_ng_schema());
    else if (format == "xsd")
        print_output(xsd_schema());
    else
        throw UsageError(fmt::format("unknown schema language '{}'; rng (RELAX NG) or xsd", format));
    return exit_code::done;
}

} // namespace

struct SchemaVerb {
    static Verb make()
    {
        return make_verb<VerbOptions>(
            {"schema", "[rng|xsd]", "print a schema of scenes for editors", "schema language", 0, 1,
             "Prints a schema of Plumb's scene language: RELAX NG (rng, the default) or W3C\n"
             "XML Schema (xsd). An editor completes and checks elements, types, parameters\n"
             "and the syntax of values with it:\n"
             "\n"
             "    renderer schema > scene.rng\n"
             "\n"
             "docs/editors.md says how. RELAX NG knows the parameters of each type; XML\n"
             "Schema takes those of any type of the same kind.\n"},
            help_option<VerbOptions>(), run);
    }
};
template const Verb& verb<SchemaVerb>();

} // namespace plumb
