macula_test(message_test
    SOURCES unit/message_test.cpp
    LINK macula_message
    LABELS fast)
