// SPDX-License-Identifier: MIT
#pragma once

// How Plumb says that something is wrong with its input. Nothing else is thrown.
//
// Messages follow LLVM's style: lower case, no full stop, the value that was given and the way out. Library code
// throws while loading and writing, never in the render loop, and never prints: the command line does.

#include <cstddef>
#include <map>
#include <set>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace plumb {

// A place in a text file: lines and columns count from 1, columns in bytes. An empty file means "no place".
struct SourceLocation {
    std::string file;
    int line = 0;
    int column = 0;
    int length = 1;           // of the marked text, in bytes
    std::string line_text;    // the line without its end, or of a very long one the part about `column`
    int line_text_column = 1; // the column at which line_text starts
    bool hides_line = false; // line_text is not shown: the file may be somebody's secrets rather than a scene

    static SourceLocation from_offset(std::string file, std::string_view text, std::size_t offset,
                                      std::size_t length = 1);
    // The same for a line that has been found already; offset counts from its start.
    static SourceLocation from_line(std::string file, int line, std::string_view text, std::size_t offset,
                                    std::size_t length = 1);
};

enum class Severity { error, warning, note };

struct Diagnostic {
    Severity severity = Severity::error;
    SourceLocation location;
    std::string message;

    // "file:line:column: error: message", and where there is a place, its line and a caret below the marked text.
    std::string text() const;
};

// An error without a place: the loader gives it the place of the element it was building.
class Error : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

// An error in a text file that is not the scene itself (a mesh, say).
class FileError : public Error {
public:
    FileError(SourceLocation location, const std::string& message)
        : Error(message), location_(std::move(location))
    {}
    const SourceLocation& location() const { return location_; }

private:
    SourceLocation location_;
};

// Every error and warning of a scene, thrown once when loading ends.
class SceneError : public Error {
public:
    explicit SceneError(std::vector<Diagnostic> diagnostics);
    const std::vector<Diagnostic>& diagnostics() const { return diagnostics_; }

private:
    std::vector<Diagnostic> diagnostics_;
};

// Collects what loading finds. The same message at the same place is kept once. Files can be wrong in a million places,
// so of each kind only the first are kept, and of each severity only so many in all; the rest is counted. A kind is the
// words of a message, without the names and numbers in them and without the way out behind a semicolon. Notes go with
// the error or warning before them.
class Diagnostics {
public:
    static constexpr std::size_t most_of_a_kind = 20;
    static constexpr std::size_t most_of_a_severity = 1000;
    static constexpr std::size_t longest_message = 2000; // bytes; longer ones are cut

    void error(const SourceLocation& at, std::string message)
    {
        add(Severity::error, at, std::move(message));
    }
    void warning(const SourceLocation& at, std::string message)
    {
        add(Severity::warning, at, std::move(message));
    }
    void note(const SourceLocation& at, std::string message) { add(Severity::note, at, std::move(message)); }
    // What can be left out: a warning where the user is lenient, else an error.
    void unsupported(const SourceLocation& at, std::string message, bool lenient);
    void add(Severity severity, const SourceLocation& at, std::string message);
    void add(const Diagnostics& others);

    bool has_errors() const { return has_errors_; }
    bool has_only_unsupported() const { return has_errors_ && !has_other_errors_; } // of errors
    bool keeps(Severity severity, std::string_view message) const; // one more message like this one
    // What was kept. The last one of a kind says how many more there were.
    const std::vector<Diagnostic>& all() const;

private:
    struct Count {
        std::size_t kept = 0;
        std::size_t left_out = 0;
        std::size_t last = 0; // of those that were kept: its number in diagnostics_
    };

    bool count(std::string kind, Severity severity); // whether it is to be kept

    std::vector<Diagnostic> diagnostics_;
    std::set<std::string> seen_;
    std::map<std::string, Count, std::less<>> kinds_;
    Count severities_[3];
    bool has_errors_ = false;
    bool has_other_errors_ = false; // than of what is unsupported
    bool leaves_out_notes_ = false;
    mutable std::vector<Diagnostic> shown_; // by all()
};

// The name of `candidates` closest to `word` if it is close enough to be a slip of the keyboard; else empty.
// Damerau-Levenshtein distance (optimal string alignment) of at most a third of the word's length, at least 1.
std::string_view closest_name(std::string_view word, const std::vector<std::string_view>& candidates);

// "; did you mean 'x'?" or, with no close name, "; known are a, b and c" ("" without candidates).
std::string way_out(std::string_view word, const std::vector<std::string_view>& candidates);

} // namespace plumb
