# Stub of the front door; see `make help`.
check:
	cmake --preset release && cmake --build build/release && ctest --test-dir build/release --output-on-failure
