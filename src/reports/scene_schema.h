// SPDX-License-Identifier: MIT
#pragma once

// Schemas of the scene language for editors: which elements, types and parameters there are, and what their values look
// like. They are of Plumb's own words (dialect plumb and the courses', which share them). Types that other programs'
// files name, and types behind a $variable, may have any parameters. What a schema cannot know is left to `renderer check`:
// ranges, required parameters, files, and that nothing is given twice.

#include <string>

namespace plumb {

// RELAX NG, XML syntax (ISO/IEC 19757-2), with the datatypes of XML Schema.
std::string relax_ng_schema();

// W3C XML Schema 1.0. What an element may contain cannot depend on its type there: parameters are those of any type of
// the kind.
std::string xsd_schema();

} // namespace plumb
