from __future__ import annotations

import numpy as np
import pytest

from planformer.data.dataset import PathDataset
from planformer.data.generate import generate_dataset
from planformer.data.shards import read_shard
from planformer.errors import InvalidDataset, InvalidParameter


def contents(folder):
    return {file.name: file.read_bytes() for file in folder.iterdir()}


def test_the_content_does_not_depend_on_the_number_of_workers(
    small_dataset, small_settings, tmp_path
):
    generate_dataset(tmp_path / "other", workers=2, **small_settings)
    assert contents(tmp_path / "other") == contents(small_dataset)


def test_missing_shards_are_made_again_and_the_others_kept(small_dataset, small_settings):
    before = contents(small_dataset)
    (small_dataset / "maze-00000.parquet").unlink()
    kept = (small_dataset / "forest-00001.parquet").stat().st_mtime_ns
    generate_dataset(small_dataset, workers=1, **small_settings)
    assert contents(small_dataset) == before
    assert (small_dataset / "forest-00001.parquet").stat().st_mtime_ns == kept


def test_indoor_maps_have_problems_too(tmp_path):
    generate_dataset(
        tmp_path, kinds=["indoor"], maps=2, paths_per_map=3, workers=1, show_progress=False
    )
    dataset = PathDataset(tmp_path)
    assert len(dataset) == 6
    assert {recipe.kind for recipe in dataset.recipes} == {"indoor"}
    expected = dataset.recipes[1].grid().blocked(0.1)
    np.testing.assert_array_equal(dataset.blocked_map(1), expected)


def test_the_seed_and_the_index_decide_on_a_map(small_dataset, small_settings, tmp_path):
    more = {**small_settings, "maps": 4, "kinds": ["maze"]}
    generate_dataset(tmp_path / "more", workers=1, **more)
    generate_dataset(tmp_path / "other", workers=1, **{**more, "seed": 6})
    first = read_shard(small_dataset / "maze-00000.parquet")
    same = read_shard(tmp_path / "more" / "maze-00000.parquet")
    other = read_shard(tmp_path / "other" / "maze-00000.parquet")
    assert same.recipes == first.recipes
    np.testing.assert_array_equal(same.vertices, first.vertices)
    seeds = [r.seed for shard in (first, other) for r in shard.recipes]
    assert len(set(seeds)) == 4


def test_a_cars_paths_depend_on_the_seed_alone(car_dataset, car_settings, tmp_path):
    generate_dataset(tmp_path / "other", workers=2, **car_settings)
    assert contents(tmp_path / "other") == contents(car_dataset)


def test_problems_without_a_path_are_counted_and_drawn_again(small_settings, tmp_path):
    # With twenty states RRT* finds some paths through a forest and misses others.
    settings = {**small_settings, "kinds": ["forest"], "expert": "rrtstar", "expert_vertices": 20}
    generate_dataset(tmp_path / "set", workers=1, **settings)
    dataset = PathDataset(tmp_path / "set")
    assert len(dataset) == 12
    assert dataset.unsolved.sum() > 0
    generate_dataset(tmp_path / "other", workers=2, **settings)
    assert contents(tmp_path / "other") == contents(tmp_path / "set")


def test_other_settings_or_another_folder_are_refused(small_dataset, small_settings, tmp_path):
    before = contents(small_dataset)
    with pytest.raises(InvalidDataset, match=r"other settings \(seed 5, not 6\)"):
        generate_dataset(small_dataset, **{**small_settings, "seed": 6})
    assert contents(small_dataset) == before
    (tmp_path / "note.txt").write_text("mine")
    with pytest.raises(InvalidDataset, match="neither empty nor a data set"):
        generate_dataset(tmp_path, **small_settings)
    with pytest.raises(InvalidDataset, match="is a file"):
        generate_dataset(tmp_path / "note.txt", **small_settings)


def test_bad_settings_leave_nothing_behind(small_settings, tmp_path):
    for bad in (
        {"workers": 0},
        {"maps": 0},
        {"maps": None},
        {"kinds": ["swamp"]},
        {"expert": "oracle"},
        {"expert_vertices": 5},  # Lazy Theta* has no such limit
        {"preset": "paper"},
        {"colour": "red"},
        {"maps_from": "nowhere"},
    ):
        with pytest.raises(InvalidParameter):
            generate_dataset(tmp_path / "set", **{**small_settings, **bad})
    assert not (tmp_path / "set").exists()


def test_settings_that_fail_do_not_claim_the_folder(small_settings, tmp_path):
    hopeless = {**small_settings, "min_distance": 50.0}
    with pytest.raises(InvalidParameter, match=r"forest number 0: only 0 of .* 50\.0 m apart"):
        generate_dataset(tmp_path / "set", workers=1, **hopeless)
    generate_dataset(tmp_path / "set", workers=1, **small_settings)
    assert len(PathDataset(tmp_path / "set")) == 24


def test_an_expert_that_solves_hardly_anything_is_an_error(small_settings, tmp_path):
    settings = {**small_settings, "kinds": ["maze"], "expert": "rrtstar", "expert_vertices": 1}
    with pytest.raises(InvalidParameter, match="maze number 0: the expert rrtstar solved 0 of 80"):
        generate_dataset(tmp_path / "set", workers=1, **settings)


def test_generated_maps_and_ones_own_go_together(own_maps, small_settings, tmp_path):
    settings = {**small_settings, "kinds": ["maze"]}
    spec = generate_dataset(tmp_path / "set", maps_from=own_maps, workers=2, **settings)
    dataset = PathDataset(tmp_path / "set")
    assert spec.total_maps == len(dataset.recipes) == 7
    assert [recipe.kind for recipe in dataset.recipes] == ["maze"] * 3 + ["user"] * 4


def test_other_maps_of_ones_own_are_another_data_set(own_maps, tmp_path):
    settings = {"maps_from": own_maps, "paths_per_map": 1, "workers": 1, "show_progress": False}
    generate_dataset(tmp_path / "set", **settings)
    generate_dataset(tmp_path / "set", **settings)
    (own_maps / "picture.png").unlink()
    with pytest.raises(InvalidDataset, match="other maps of your own"):
        generate_dataset(tmp_path / "set", **settings)
