#include "cli/console.h"
#include "cli/run.h"

int main(int count, char** arguments) {
  fusee::cli::make_streams_safe();
  return fusee::cli::run({arguments + (count > 0 ? 1 : 0), arguments + count});
}
