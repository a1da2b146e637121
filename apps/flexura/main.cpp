#include <CLI/CLI.hpp>
#include <csignal>
#include <exception>

#include "apps/flexura/commands.hpp"
#include "apps/flexura/terminal.hpp"

namespace {

using namespace flexura::app;

void add_model(CLI::App& command, ModelArguments& arguments) {
  command.add_option("model", arguments.file, "the model file (TOML)")->required();
  command.add_option("--set", arguments.assignments, "give a parameter another value: name=value");
}

CLI::App* add_draw(CLI::App& app, DrawArguments& draw) {
  CLI::App* command = app.add_subcommand("draw", "draw a study as an animated picture (SVG)");
  add_model(*command, draw.model);
  command->add_option("-o,--output", draw.output, "the file to write (default: MODEL.svg)");
  command->add_option("--study", draw.study, "the study (default: the first with a shape)");
  command->add_option("--modeling", draw.modeling,
                      "the modeling, or a linkage's method (default: the study's reference)");
  command->add_option("--mode", draw.mode, "number of the mode (default: 1, the lowest)")
      ->check(CLI::Range(1, 1000));
  command
      ->add_option("--exaggerate", draw.exaggeration,
                   "draw displacements as many times as far (default: 1, more if unseen); "
                   "of a mode the amplitude")
      ->check(CLI::PositiveNumber);
  command->add_flag("--still,!--moving", draw.still, "the most deformed state alone");
  command->add_flag("-q,--quiet", draw.quiet, "print errors only");
  return command;
}

int run(int argc, char** argv) {
  CLI::App app("Planar mechanisms that move because they bend.", "flexura");
  app.set_version_flag("--version", "flexura " FLEXURA_VERSION);
  app.require_subcommand(1);

  RunArguments run;
  CLI::App* run_app = app.add_subcommand("run", "run a model's studies and write the results");
  add_model(*run_app, run.model);
  run_app->add_option("-o,--output", run.output, "results folder (default: MODEL.results)");
  run_app->add_option("--study", run.studies, "run this study only; may be repeated");
  run_app->add_option("--modeling", run.modelings, "run this modeling only; may be repeated");
  run_app->add_option("--threads", run.threads, "number of threads (default: all processors)")
      ->check(CLI::Range(1, 1024));
  run_app->add_flag("-q,--quiet", run.quiet, "print errors only");

  ModelArguments check;
  bool quiet_check = false;
  CLI::App* check_app = app.add_subcommand("check", "report every mistake in a model file");
  add_model(*check_app, check);
  check_app->add_flag("-q,--quiet", quiet_check, "print errors only");

  DrawArguments draw;
  const CLI::App* draw_app = add_draw(app, draw);

  std::filesystem::path new_file;
  CLI::App* new_app = app.add_subcommand("new", "write a commented model file to start from");
  new_app->add_option("file", new_file, "the file to write")->required();

  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? all_finished : wrong_input;
  }
  if (*run_app) return run_command(run);
  if (*draw_app) return draw_command(draw);
  if (*check_app) return check_command(check, quiet_check);
  return new_command(new_file);
}

}  // namespace

int main(int argc, char** argv) {
  // a file that gets too long is an error of writing, with a message
  std::signal(SIGXFSZ, SIG_IGN);
  try {
    return run(argc, argv);
  } catch (const std::bad_alloc&) {
    print_error("out of memory");
  } catch (const std::exception& error) {
    print_error(error.what());
  }
  return stopped_early;
}
