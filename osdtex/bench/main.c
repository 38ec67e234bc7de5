/* main.c -- osdtex-bench: times stages (-s, the default) or verifies them
 * against slow references (-y). */
#include "bench/bench_match.h"

#include <stdio.h>
#include <string.h>

int
main(int argc, char **argv)
{
    const int verify = argc == 2 && strcmp(argv[1], "-y") == 0;

    if (argc > 2 || (argc == 2 && !verify && strcmp(argv[1], "-s") != 0))
    {
        fprintf(stderr, "usage: osdtex-bench [-s | -y]\n");
        return 1;
    }
    return bench_match(verify);
}
