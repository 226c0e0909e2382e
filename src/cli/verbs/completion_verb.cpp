// SPDX-License-Identifier: MIT
#include "cli/completion.h"
#include "cli/console.h"
#include "cli/usage_error.h"
#include "cli/verb_file.h"
#include "reports/exit_codes.h"

#include <fmt/format.h>

namespace plumb {

namespace {

// Each script asks the program itself, and so never falls behind it: `completion --of WORD...` prints a line for each
// candidate, with its summary behind a tab; the line ":files" stands for names of files.
constexpr std::string_view asking = "--of";

constexpr std::string_view bash_script = R"(# bash completion for Plumb's renderer
_plumb_renderer()
{
    local line word candidates=() files=""
    COMPREPLY=()
    while IFS= read -r line; do
        if [[ $line == :files ]]; then files=1; else candidates+=("${line%%$'\t'*}"); fi
    done < <("${COMP_WORDS[0]/#\~/$HOME}" completion --of "${COMP_WORDS[@]:1:COMP_CWORD}" 2>/dev/null)
    word=${COMP_WORDS[COMP_CWORD]}
    [[ $word == = ]] && word=""
    for line in "${candidates[@]}"; do
        # bash replaces only what stands behind the "=".
        [[ $COMP_WORDBREAKS == *=* && $line == --*=* ]] && line=${line#*=}
        COMPREPLY+=("$line")
    done
    if [[ -n $files ]]; then
        compopt -o filenames
        while IFS= read -r line; do COMPREPLY+=("$line"); done < <(compgen -f -- "$word")
    fi
}
complete -F _plumb_renderer renderer
)";

constexpr std::string_view zsh_script = R"(#compdef renderer
# zsh completion for Plumb's renderer
_plumb_renderer()
{
    local line files=""
    local -a described
    for line in "${(@f)$("${(Q)words[1]/#\~/$HOME}" completion --of "${(@Q)words[2,CURRENT]}" 2>/dev/null)}"; do
        if [[ $line == :files ]]; then
            files=1
        elif [[ -n $line ]]; then
            described+=("${${line%%$'\t'*}//:/\\:}:${line#*$'\t'}")
        fi
    done
    (( ${#described} )) && _describe 'renderer' described
    [[ -n $files ]] && _files
}
if [[ $funcstack[1] == _renderer ]]; then _plumb_renderer "$@"; else compdef _plumb_renderer renderer; fi
)";

constexpr std::string_view fish_script = R"(# fish completion for Plumb's renderer
function __plumb_renderer
    set -l words (commandline -opc)
    set -l typed (commandline -ct)
    for line in ($words[1] completion --of $words[2..-1] "$typed" 2>/dev/null)
        if test "$line" = :files
            __fish_complete_path "$typed"
        else
            printf '%s\n' $line
        end
    end
end
complete -c renderer -f -a '(__plumb_renderer)'
)";

int answer(const std::vector<std::string>& words)
{
    const Completions found = complete(words);
    for (const Completion& one : found.words)
        print_output(one.summary.empty() ? one.word + "\n" : fmt::format("{}\t{}\n", one.word, one.summary));
    if (found.files) print_output(":files\n");
    return exit_code::done;
}

int run(const VerbOptions& options)
{
    const std::string& shell = options.subject();
    if (shell == "bash")
        print_output(bash_script);
    else if (shell == "zsh")
        print_output(zsh_script);
    else if (shell == "fish")
        print_output(fish_script);
    else
        throw UsageError(fmt::format("unknown shell '{}'; bash, zsh or fish", shell));
    return exit_code::done;
}

} // namespace

struct CompletionVerb {
    static Verb make()
    {
        Verb verb = make_verb<VerbOptions>(
            {"completion", "bash|zsh|fish", "print the completion of a shell", "shell", 1, 1,
             "Prints a script that makes the shell complete verbs, options, their values\n"
             "and names of types:\n"
             "\n"
             "    source <(renderer completion bash)      # in ~/.bashrc\n"
             "    source <(renderer completion zsh)       # in ~/.zshrc, after compinit\n"
             "    renderer completion fish | source       # in ~/.config/fish/config.fish\n"},
            help_option<VerbOptions>(), run);
        // What the scripts ask: the words are those of another command line.
        verb.parse = [parse = verb.parse](const std::vector<std::string>& words) -> std::function<int()> {
            if (words.size() < 2 || words[1] != asking) return parse(words);
            return
                [asked = std::vector<std::string>(words.begin() + 2, words.end())] { return answer(asked); };
        };
        return verb;
    }
};
template const Verb& verb<CompletionVerb>();

} // namespace plumb
