#include "fusee/base/files.h"
