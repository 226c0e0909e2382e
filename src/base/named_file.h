// SPDX-License-Identifier: MIT
#pragma once

// Where a file lies that another file names. Everything that a scene, a test or a suite reads is looked for here.

#include <filesystem>
#include <string>

namespace plumb {

struct NamedFile {
    std::filesystem::path path; // if there is nothing of that name: where it should be
    std::string way_out;        // then what could be meant: "; did you mean 'q.obj'?"; may be empty
    std::string notice;         // what to say of a file that is not where its name says
};

// `name` is seen from `directory`, that of the file that names it; if there is nothing, from the working directory. Then an absolute
// path is one of another computer, of which as much counts as names a file that is seen from `directory`; and a relative one is
// seen from a directory above, for that is where others have run their programs. \ separates
// directories, too, as in files from Windows, unless there is a file with that very name. A name that differs from a file's in
// upper and lower case only is no name of it: which of two such files is meant would depend on what else is there.
NamedFile find_named_file(const std::filesystem::path& directory, const std::string& name);

} // namespace plumb
