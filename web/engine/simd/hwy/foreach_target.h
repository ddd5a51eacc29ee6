// One target: a file is compiled once (see highway.h here).
#pragma once
