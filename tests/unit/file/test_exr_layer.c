/* test_exr_layer.c -- which channels of a file are its colour. */
#include "exr_support.h"

static void
test_layers_are_found_and_named(void **state)
{
    const fixture *f = *state;
    const otx_picture picture = made(
        f, "a.exr --chnames diffuse.R,diffuse.G,diffuse.B -d half "
           "a.exr --ch R --chnames Z --chappend");
    test_same_image(&picture.image, &f->image, 1e-3);
    assert_string_equal(picture.layer, "diffuse");
    assert_non_null(strstr(test_last_message(f->run), "diffuse"));
}

static void
test_first_part_with_color_is_used(void **state)
{
    const fixture *f = *state;
    const otx_picture picture =
        made(f, "a.exr --ch R --chnames Z a.exr --siappend a.exr --siappend");
    assert_int_equal(picture.part, 1);
    test_same_image(&picture.image, &f->image, 0.0);
    assert_non_null(strstr(test_last_message(f->run), "part 1"));
}

/* Colours of another kind in front of, and beside, the picture. */
static void
test_the_right_layer_is_read(void **state)
{
    static const struct
    {
        const char *arguments; /* a.exr is the picture, g a grey one */
        const char *layer;     /* NULL plain */
    } cases[] = {
        {"g.exr --chnames N.R,N.G,N.B a.exr --chappend", NULL},
        {"g.exr --chnames crypto00.R,crypto00.G,crypto00.B a.exr --chnames "
         "rgba.R,rgba.G,rgba.B --chappend",
         "rgba"},
        {"g.exr --chnames diffuse.R,diffuse.G,diffuse.B a.exr --chnames "
         "beauty.R,beauty.G,beauty.B --chappend",
         "beauty"},
        {"g.exr --chnames V.Normal.R,V.Normal.G,V.Normal.B a.exr --chnames "
         "V.Combined.R,V.Combined.G,V.Combined.B --chappend",
         "V.Combined"},
        {"g.exr --attrib oiio:subimagename crypto00 --chnames "
         "crypto00.R,crypto00.G,crypto00.B a.exr --attrib oiio:subimagename "
         "diffuse --siappend",
         "diffuse"},
        {"g.exr --attrib oiio:subimagename N a.exr --attrib "
         "oiio:subimagename main --siappend",
         "main"},
    };
    const fixture *f = *state;

    make(f, "--create 100x70 3 -d half -o g.exr");
    for (size_t i = 0; i < sizeof cases / sizeof *cases; ++i)
    {
        const otx_picture picture = made(f, cases[i].arguments);

        test_same_image(&picture.image, &f->image, 1e-3);
        if (cases[i].layer)
            assert_string_equal(picture.layer, cases[i].layer);
        else
            assert_null(picture.layer);
    }
}

/* Several that may be meant, none that can be: they are listed, and taken when
 * they are asked for. */
static void
test_unclear_layers_are_listed(void **state)
{
    const fixture *f = *state;
    otx_picture picture;

    make(
        f, "a.exr --chnames key.R,key.G,key.B a.exr --mulc 0.5 --chnames "
           "fill.R,fill.G,fill.B --chappend -d float -o b.exr");
    refuse(f, "b.exr", OSDTEX_ERROR_SUPPORT, "layer: fill, key");
    make(f, "a.exr --chnames N.R,N.G,N.B -o c.exr");
    refuse(f, "c.exr", OSDTEX_ERROR_SUPPORT, "layer: N");
    assert_int_equal(
        otx_picture_read_layer(
            f->run, test_path(&f->folder, "b.exr"), "key", &picture),
        OSDTEX_OK);
    test_same_image(&picture.image, &f->image, 0.0);
    assert_int_equal(
        otx_picture_read_layer(
            f->run, test_path(&f->folder, "b.exr"), "rim", &picture),
        OSDTEX_ERROR_ARGUMENT);
    assert_non_null(strstr(test_last_message(f->run), "it has fill, key"));
}

static void
test_uint_channels_are_numbers(void **state)
{
    const fixture *f = *state;
    const otx_picture picture =
        made(f, "--create 5x3 3 --addc 1,0,1 -d uint32");
    assert_int_equal(picture.bits, 32);
    assert_float_equal(picture.image.pixels[0], 4294967295.0, 256.0);
    assert_float_equal(picture.image.pixels[1], 0.0, 0.0);
}

int
main(void)
{
#define TEST(name) cmocka_unit_test_setup_teardown(name, begin, end)
    const struct CMUnitTest tests[] = {
        TEST(test_layers_are_found_and_named),
        TEST(test_first_part_with_color_is_used),
        TEST(test_the_right_layer_is_read),
        TEST(test_unclear_layers_are_listed),
        TEST(test_uint_channels_are_numbers),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
