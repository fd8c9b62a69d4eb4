"""Results on the very objects, kept in the file, and the document as it was when they are taken away."""

from blender import OFFICE, InBlender, run


class Display(InBlender):
    def setUp(self):
        self.result = self.once("inside_display.py", file=OFFICE)

    def test_every_object_shows_its_own_values_also_when_meshes_are_shared(self):
        for name, (shown, first, last) in self.result["shown"].items():
            self.assertTrue(shown, name)
            if not name.startswith("Asset stool"):  # drawn three times: the last drawing shows
                self.assertAlmostEqual(self.result["values"][name][0], first, places=3, msg=name)
                self.assertAlmostEqual(self.result["values"][name][1], last, places=3, msg=name)
            self.assertEqual(self.result["values"][name][2], "illuminance_colour")
            for names in self.result["values"][name][3:]:
                self.assertEqual(set(names), {"Lightwell false colour"}, name)

    def test_values_and_legend_are_still_there_when_the_file_is_opened_again(self):
        self.assertEqual(self.result["kept"], self.result["values"]["Bürostuhl 02"])
        self.assertEqual(self.result["legend"], [300, 480])
        self.assertGreater(self.result["bright"], 0.9)
        self.assertEqual(self.result["texts"], ["Lightwell results", "Lightwell results.csv"])

    def test_a_grid_is_an_object_whose_cells_lie_over_its_floor(self):
        self.assertEqual(self.result["grid_faces"], 384)
        self.assertAlmostEqual(self.result["grid_area"], 24, places=3)
        self.assertAlmostEqual(self.result["grid_normal"], 1, places=5)

    def test_the_table_goes_into_a_file(self):
        self.assertEqual(self.result["table"], "kind,name\n")

    def test_taking_the_results_away_gives_back_the_document_as_it_was(self):
        self.assertEqual(self.result["before"], self.result["after"])
        self.assertEqual(self.result["again"], 0)


if __name__ == "__main__":
    run()
