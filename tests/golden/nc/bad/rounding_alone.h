; run: failed line 4: Rounding-off undefined: RND and CHF must be between two positioning blocks
BEGIN PGM BAD MM
TOOL CALL 30 Z F100
RND R5
END PGM BAD MM
