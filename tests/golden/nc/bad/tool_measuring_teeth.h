; run: failed line 5: Tool data inconsistent: single teeth are measured with 1 to 20 of them in the column CUT
BEGIN PGM BAD MM
TOOL DEF 5 L+100 R+6
TOOL CALL 5 Z
TCH PROBE 482 CAL. TOOL RADIUS ~
    Q340=+1 ~
    Q260=+100 ~
    Q341=+1
END PGM BAD MM
