#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <exception>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "orchestrator/commands.hpp"
#include "schemas/failure.hpp"
#include "schemas/nearest.hpp"
#include "schemas/version.hpp"

namespace {

using cupola::ExitCode;
using cupola::Failure;

int tell(const Failure& failure) {
  fmt::print(stderr, "{}\n", failure.what());
  for (const auto& [key, value] : failure.advice()) fmt::print(stderr, "  try {}: {}\n", key, value);
  return static_cast<int>(failure.code());
}

/// What is wrong with the first word, where it is none of the commands.
std::optional<Failure> wrong_command(const CLI::App& app, int argc, char** argv) {
  std::vector<std::string> known;
  for (const CLI::App* command : app.get_subcommands({})) known.push_back(command->get_name());
  const auto choices = fmt::format("one of {} (`cupola --help` explains them)", fmt::join(known, ", "));
  if (argc < 2) return Failure(ExitCode::wrong_input, "say what to do: " + choices);
  const std::string word = argv[1];
  if (word.starts_with('-') || std::find(known.begin(), known.end(), word) != known.end()) return std::nullopt;
  return Failure(ExitCode::wrong_input, fmt::format("there is no command `{}`{}: expected {}", word,
                                                    cupola::suggestion(word, known), choices));
}

int run_command(const std::function<ExitCode()>& command) {
  try {
    return static_cast<int>(command());
  } catch (const Failure& failure) {
    return tell(failure);
  } catch (const std::filesystem::filesystem_error& problem) {
    return tell(Failure(ExitCode::input_output, problem.what()));
  } catch (const std::exception& problem) {
    return tell(Failure(ExitCode::wrong_input, problem.what()));
  }
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Thermal steady states of moving beds: campaigns of a DEM stage and a tracer stage in turns.", "cupola");
  app.set_version_flag("--version", std::string("cupola ") + cupola::program_version);
  app.require_subcommand(1);
  app.footer(
      "Exit status: 0 done or converged, 65 the input is wrong, 70 a stage diverged, 73 another process holds the "
      "folder,\n"
      "74 a file could not be read or written, 75 stopped or not yet converged: resumable.");

  std::filesystem::path campaign, folder;
  std::optional<std::filesystem::path> run_folder;
  cupola::MarchOptions options;
  bool as_json = false, in_chain = false, is_link = false, watched = false;
  std::string host = "127.0.0.1";
  int port = 8127;
  std::function<ExitCode()> command;

  const auto with_campaign = [&](CLI::App* sub) {
    sub->add_option("CAMPAIGN", campaign, "The campaign file (YAML)")->required();
    return sub;
  };
  const auto with_folder = [&](CLI::App* sub) {
    sub->add_option("RUN", folder, "A run folder")->required();
    return sub;
  };
  const auto with_json = [&](CLI::App* sub) { sub->add_flag("--json", as_json, "Answer in JSON"); };
  const auto with_limits = [&](CLI::App* sub) {
    sub->add_option("--at-most", options.at_most, "Episodes at most, instead of the campaign's limit")
        ->check(CLI::Range(1, 1000000));
    sub->add_option("--ranks", options.ranks, "Ranks for the stages from now on, instead of the campaign's")
        ->check(CLI::Range(1, 1000000));
    sub->add_flag("--accept-versions", options.accept_versions,
                  "Go on although program or libraries are of other versions than those the run goes by");
    sub->add_option_function<double>(
           "--stop-within", [&](double seconds) { options.stop_within = std::chrono::duration<double>(seconds); },
           "Seconds after which a stage that was asked to stop is killed")
        ->check(CLI::PositiveNumber);
    sub->add_option("--until-episode", options.until_episode, "Stop after this episode; `resume` goes on")
        ->check(CLI::Range(1, 1000000));
  };

  const auto with_submit = [&](CLI::App* sub) {
    sub->add_flag("--submit", in_chain,
                  "Queue the whole campaign in Slurm as a chain of jobs; nothing is left running here");
  };

  CLI::App* validate = with_campaign(app.add_subcommand("validate", "List all errors of a campaign file"));
  with_json(validate);
  validate->callback([&] { command = [&] { return cupola::validate(campaign, as_json); }; });

  CLI::App* explain = with_campaign(
      app.add_subcommand("explain", "Say what will be computed and why, whether the ore melts, how long it takes"));
  with_json(explain);
  explain->callback([&] { command = [&] { return cupola::explain(campaign, as_json); }; });

  CLI::App* predict =
      with_campaign(app.add_subcommand("predict", "Predict the steady state in a minute, without running any stage"));
  predict->add_option("--run-dir", run_folder, "The run folder; without it runs/<campaign>");
  predict->callback([&] { command = [&] { return cupola::predict(campaign, run_folder); }; });

  CLI::App* run = with_campaign(app.add_subcommand("run", "Run a campaign, or go on with its run folder"));
  run->add_option("--run-dir", run_folder, "The run folder; without it runs/<campaign>");
  with_limits(run);
  with_submit(run);
  run->callback([&] {
    command = [&] {
      return in_chain ? cupola::submit(campaign, run_folder, options) : cupola::run(campaign, run_folder, options);
    };
  });

  CLI::App* resume = with_folder(app.add_subcommand("resume", "Go on with a run that was stopped or killed"));
  with_limits(resume);
  with_submit(resume);
  resume->add_flag("--chain-link", is_link)->group("");  // what a job of the chain is
  resume->callback([&] {
    command = [&] {
      if (is_link) return cupola::chain_link(folder, options);
      return in_chain ? cupola::submit_again(folder, options) : cupola::resume(folder, options);
    };
  });

  CLI::App* status = with_folder(app.add_subcommand("status", "Say how a run stands; changes nothing"));
  with_json(status);
  status->add_flag("--watch", watched, "Show it again and again, until the campaign has ended");
  status->callback([&] { command = [&] { return cupola::status(folder, as_json, watched); }; });

  CLI::App* serve = with_folder(
      app.add_subcommand("serve", "Show the report of a run in a browser, kept up to date; changes nothing"));
  serve->add_option("--host", host, "The address to listen at")->capture_default_str();
  serve->add_option("--port", port, "The port to listen at; 0: any free one")
      ->capture_default_str()
      ->check(CLI::Range(0, 65535));
  serve->callback([&] { command = [&] { return cupola::serve(folder, host, port); }; });

  CLI::App* verify =
      with_folder(app.add_subcommand("verify", "Compare every byte of a run with its hashes; changes nothing"));
  with_json(verify);
  verify->callback([&] { command = [&] { return cupola::verify(folder, as_json); }; });

  CLI::App* report =
      with_folder(app.add_subcommand("report", "Make the report of a run anew, at whatever point it stands"));
  report->callback([&] { command = [&] { return cupola::report(folder); }; });

  cupola::StudyOptions study_options;
  CLI::App* study = app.add_subcommand("study", "Run one scene at many settings: error against run time");
  study->add_option("STUDY", campaign, "The study file (YAML)")->required();
  study->add_option("--study-dir", study_options.folder, "Its folder; without it studies/<study>");
  study->add_option("--jobs", study_options.jobs, "Settings at once, instead of the file's")
      ->check(CLI::Range(1, 1000));
  study->add_flag("--reduced", study_options.reduced, "At the size of the file's section `reduced`");
  study->add_flag("--check", study_options.only_check, "List the settings and run nothing");
  study->add_flag("--gather", study_options.only_gather, "Make the results anew from what is there; run nothing");
  study->add_flag("--retry-failed", study_options.retry_failed, "Try again what has failed");
  study->add_flag("--submit", study_options.submit, "Queue it in Slurm as arrays of jobs");
  study->add_option("--task", study_options.task)->group("");  // what a member of an array does
  study->callback([&] { command = [&] { return cupola::study(campaign, study_options); }; });

  CLI::App* init = app.add_subcommand("init", "Write a commented campaign file to begin with");
  init->add_option("DIR", folder, "The folder to write campaign.yaml into")->required();
  init->callback([&] { command = [&] { return cupola::init(folder); }; });

  CLI::App* doctor = app.add_subcommand("doctor", "Check the installation, with a trial run on two ranks");
  doctor->callback([&] { command = [] { return cupola::doctor(); }; });

  if (const auto wrong = wrong_command(app, argc, argv)) return tell(*wrong);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : static_cast<int>(ExitCode::wrong_input);
  }
  return run_command(command);
}
