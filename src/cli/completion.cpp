#include "cli/candidates.h"
#include "cli/command.h"

namespace fusee::cli {
namespace {

// Each script asks the program, so that a shell offers what the program accepts. An answer has one word per
// line and, after a tab, its meaning. ":files.toml" stands for the names of files with that ending, ":files" for those
// of all files, and ":open" for no blank after the word.

constexpr std::string_view k_bash = R"sh(# In ~/.bashrc: source <(fusee completion bash)
_fusee() {
  local line="${COMP_LINE:0:$COMP_POINT}" typed word meaning
  local current="${COMP_WORDS[COMP_CWORD]}"
  typed="${line##*[[:space:]]}"
  COMPREPLY=()
  while IFS=$'\t' read -r word meaning; do
    case "$word" in
      :files*)
        compopt -o filenames
        mapfile -t -O ${#COMPREPLY[@]} COMPREPLY < <(compgen -d -- "$current"; compgen -f -X "!*${word#:files}" -- "$current")
        ;;
      :open) compopt -o nospace ;;
      *)
        # bash begins a new word behind "=".
        if [[ "$typed" == *=* && "$COMP_WORDBREAKS" == *=* ]]; then word="${word#*=}"; fi
        COMPREPLY+=("$word")
        ;;
    esac
  done < <("$1" completion candidates "$line" 2>/dev/null)
}
complete -F _fusee fusee
)sh";

constexpr std::string_view k_zsh = R"sh(#compdef fusee
# In ~/.zshrc, after compinit: source <(fusee completion zsh)
_fusee() {
  local word meaning
  local -a found open
  while IFS=$'\t' read -r word meaning; do
    case "$word" in
      :files*) _files -g "*${word#:files}(-.)" ;;
      :open) open=(-S '') ;;
      *) found+=("${word//:/\\:}${meaning:+:$meaning}") ;;
    esac
  done < <("${words[1]}" completion candidates "${(j: :)words[1,CURRENT]}" 2>/dev/null)
  (( ${#found} )) && _describe 'fusee' found "${open[@]}"
}
compdef _fusee fusee
)sh";

constexpr std::string_view k_fish = R"sh(# fusee completion fish > ~/.config/fish/completions/fusee.fish
function __fusee_candidates
  set -l program (commandline -opc)[1]
  for line in ($program completion candidates (commandline -cp | string collect) 2>/dev/null)
    switch $line
      case ':files'
        __fish_complete_path (commandline -ct)
      case ':files*'
        __fish_complete_suffix (string replace ':files' '' -- $line)
      case ':open'
      case '*'
        echo $line
    end
  end
end
complete -c fusee -f -a '(__fusee_candidates)'
)sh";

Reply answer_of(std::string_view line) {
  const Candidates found = candidates(line);
  Reply reply;
  reply.fields["candidates"] = Json::array();
  if (found.goes_on) reply.text += ":open\n";
  for (const Candidate& one : found.words) {
    reply.text += one.word + (one.meaning.empty() ? "" : "\t" + one.meaning) + "\n";
    reply.fields["candidates"].push_back({{"word", one.word}, {"meaning", one.meaning}});
  }
  if (found.files) reply.text += ":files" + found.ending + "\n";
  reply.fields["files"] = found.files;
  return reply;
}

Reply run_completion(const Arguments& arguments, Console&, const RunContext&) {
  const std::string& shell = arguments.positionals().front();
  if (shell == "candidates")
    return answer_of(arguments.positionals().size() > 1 ? arguments.positionals()[1] : std::string());
  Reply reply;
  if (shell == "bash") reply.text = k_bash;
  if (shell == "zsh") reply.text = k_zsh;
  if (shell == "fish") reply.text = k_fish;
  if (reply.text.empty())
    throw UsageError("there is no completion for '" + shell + "'", "it is one of bash, zsh, fish");
  reply.fields["shell"] = shell;
  reply.fields["script"] = reply.text;
  return reply;
}

}  // namespace

Command completion_command() {
  return {"completion",
          "SHELL [LINE]",
          "shell completion",
          "Prints a script for SHELL (bash, zsh or fish) that lets the Tab key offer\n"
          "commands, options, templates, keys of the mechanism file and their values.\n"
          "Scripts call 'fusee completion candidates LINE': a word and meaning per line.",
          {},
          {{"source <(fusee completion bash)", "in this shell; in ~/.bashrc for all"},
           {"fusee completion fish > fusee.fish", "for ~/.config/fish/completions"},
           {"fusee completion candidates 'fusee build --d'", "the possible words"}},
          run_completion};
}

}  // namespace fusee::cli
