# Installing and exporting: find_package(equipoise) from an outside project.
