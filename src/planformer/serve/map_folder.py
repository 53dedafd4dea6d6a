"""A folder of maps: those that lie there, and uploads that outlive the service."""

from __future__ import annotations

import json
import logging
from pathlib import Path

from planformer.errors import InvalidParameter, PlanformerError, RequestRefused, StoreFull
from planformer.files import make_folder, remove_unfinished, write_files
from planformer.maps import load_map, save_map
from planformer.maps.folder import map_files, picture_of
from planformer.serve.responses import MapInfo
from planformer.serve.served_map import ServedMap
from planformer.serve.settings import ServeSettings

_log = logging.getLogger(__name__)


class MapFolder:
    """Maps in a folder; not safe to use from several threads.

    Every map file in the folder is offered under its name, until it is removed. An upload is
    written as a ROS map `ID.yaml` with its picture and, as a mark that the service wrote it,
    `ID.json` with its name.

    Args:
        path: The folder; it is made if it does not exist.
        settings: Bounds of maps.

    Raises:
        InvalidParameter: The folder cannot be made.
    """

    def __init__(self, path: Path, settings: ServeSettings) -> None:
        make_folder(path)
        remove_unfinished(path)
        self._path = path.resolve()
        self._settings = settings
        self._files: dict[str, Path] = {}
        self.infos: dict[str, MapInfo] = {}
        for file in map_files(self._path):
            self._take_in(file)

    def save(self, served: ServedMap) -> None:
        """Write a map, unless it is here already.

        Raises:
            StoreFull: The folder holds as many maps as it may, or cannot be written to.
        """
        info = served.info
        if self.has(info.id):
            return
        if len(self.infos) >= self._settings.maps:
            raise StoreFull(f"the folder holds {self._settings.maps} maps already; delete some")
        file = self._path / f"{info.id}.yaml"
        try:
            write_files({_mark(file): json.dumps({"name": served.name}).encode()})
            save_map(served.grid, file)
        except InvalidParameter as error:
            _mark(file).unlink(missing_ok=True)
            raise StoreFull(f"the folder takes no map: {error}") from error
        self._files[info.id], self.infos[info.id] = file, info

    def has(self, map_id: str) -> bool:
        """Whether the map of an id is here; it is forgotten if somebody has removed its file."""
        if map_id in self._files and not self._files[map_id].is_file():
            self._forget(map_id)
        return map_id in self._files

    def load(self, map_id: str) -> ServedMap | None:
        """The map of an id; None if there is none, or its file is another map now."""
        if not self.has(map_id):
            return None
        served = self._read(self._files[map_id])
        return served if served is not None and served.info.id == map_id else None

    def remove(self, map_id: str) -> None:
        """Remove a map's files.

        Raises:
            RequestRefused: They are not the service's own, or cannot be removed.
        """
        file = self._files[map_id]
        if not self._is_own(file, map_id):
            raise RequestRefused("this map's file was not written here; remove it by hand")
        try:
            for name in (file, file.with_suffix(".pgm"), _mark(file)):
                name.unlink(missing_ok=True)
        except OSError as error:
            raise RequestRefused(f"the map cannot be removed: {error.strerror or error}") from error
        self._forget(map_id)

    def _forget(self, map_id: str) -> None:
        del self._files[map_id], self.infos[map_id]

    def _take_in(self, file: Path) -> None:
        served = self._read(file)
        if served is not None:
            self._files[served.info.id], self.infos[served.info.id] = file, served.info

    def _read(self, file: Path) -> ServedMap | None:
        """A map file, None with a warning if it is not to be served."""
        parts = [part for part in (file.resolve(), picture_of(file)) if part is not None]
        if not all(part.is_relative_to(self._path) for part in parts):
            _log.warning("%s lies or points outside the folder; it is left out", file)
            return None
        try:
            grid = load_map(file)
        except PlanformerError as error:
            _log.warning("%s is left out: %s", file, error)
            return None
        if grid.occupied.size > self._settings.map_cells:
            _log.warning("%s is left out: it has %d cells", file, grid.occupied.size)
            return None
        served = ServedMap(file.stem, grid)
        if self._is_own(file, served.info.id):
            served = ServedMap(_name(file), grid)
        return served

    def _is_own(self, file: Path, map_id: str) -> bool:
        """Whether the service has written a file: no other name tells a content."""
        return file == self._path / f"{map_id}.yaml" and _mark(file).is_file()


def _mark(file: Path) -> Path:
    return file.with_suffix(".json")


def _name(file: Path) -> str:
    """The name under which the service saved a map; the file's if that is damaged."""
    try:
        return str(json.loads(_mark(file).read_text(encoding="utf-8"))["name"])
    except (OSError, ValueError, TypeError, KeyError):
        return file.stem
