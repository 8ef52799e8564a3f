# SPDX-License-Identifier: 0BSD
"""METHOD_NAME: each vertex of A with the nearest one of B. Replace it by a method of yours."""

import numpy


class Method:
    def __init__(self, vertices_a, triangles_a, vertices_b, triangles_b, cutoff, options):
        """Vertices: (n, 3) [m]. Triangles: (n, 3) vertex numbers. options: a dict that holds every option."""
        self.a, self.triangle_a = self.used(vertices_a, triangles_a)
        self.b, self.triangle_b = self.used(vertices_b, triangles_b)
        self.cutoff = cutoff

    @staticmethod
    def used(vertices, triangles):
        """Vertices that are corners, each with a triangle that it is a corner of."""
        corners, places = numpy.unique(triangles, return_index=True)
        return vertices[corners], places // 3

    def search(self, pose):
        """pose: (3, 4), p_B = pose[:, :3] p_A + pose[:, 3]. Returns points on A and on B in B's frame, (n, 3) each, and the
        triangles of A and B that carry them, (n, 2); nearest first."""
        a = self.a @ pose[:, :3].T + pose[:, 3]
        squared = ((a[:, None, :] - self.b[None, :, :]) ** 2).sum(axis=2)
        nearest = squared.argmin(axis=1)
        distance = numpy.sqrt(squared[numpy.arange(len(a)), nearest])
        order = numpy.argsort(distance, kind="stable")
        order = order[distance[order] <= self.cutoff]
        pairs = nearest[order]
        return a[order], self.b[pairs], numpy.stack([self.triangle_a[order], self.triangle_b[pairs]], axis=1)
